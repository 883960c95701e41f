// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_edges.h"

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace accuracy {

namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180.0;
constexpr double LEAST_ANGLE = 8.0;

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<std::size_t>> faces;
};

/** \brief The v and f lines of an OBJ. */
void
readObj (std::istream& stream, Mesh& mesh)
{
  for (std::string line; std::getline (stream, line);) {
    std::istringstream words (line);
    std::string word;
    words >> word;
    if (word == "v") {
      Eigen::Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      mesh.vertices.push_back (p);
    }
    else if (word == "f") {
      mesh.faces.emplace_back();
      // Of "7/5/2" the number of the vertex, from 1.
      while (words >> word)
        mesh.faces.back().push_back (std::stoul (word) - 1);
    }
  }
}

void
readOff (std::istream& stream, Mesh& mesh)
{
  std::string header;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  stream >> header >> vertices >> faces >> edges;
  for (std::size_t i = 0; i < vertices && stream; ++i) {
    Eigen::Vector3d p;
    stream >> p.x() >> p.y() >> p.z();
    mesh.vertices.push_back (p);
  }
  for (std::size_t i = 0; i < faces && stream; ++i) {
    std::size_t corners = 0;
    stream >> corners;
    mesh.faces.emplace_back();
    for (std::size_t vertex = 0; corners-- > 0 && stream >> vertex;)
      mesh.faces.back().push_back (vertex);
  }
}

/** \brief Twice the area, along the normal. */
Eigen::Vector3d
areaOf (const Mesh& mesh, const std::vector<std::size_t>& face)
{
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = mesh.vertices[face[0]];
  for (std::size_t i = 2; i < face.size(); ++i)
    area +=
        (mesh.vertices[face[i - 1]] - origin).cross (mesh.vertices[face[i]] - origin);
  return area;
}

Eigen::Vector3d
middleOf (const Mesh& mesh, const std::vector<std::size_t>& face)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t vertex : face)
    sum += mesh.vertices[vertex];
  return sum / static_cast<double> (face.size());
}

std::vector<SharpEdge>
sharpEdgesOf (const Mesh& mesh)
{
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> faces_of;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<std::size_t>& face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i)
      faces_of[std::minmax (face[i], face[(i + 1) % face.size()])].push_back (f);
  }
  std::vector<SharpEdge> edges;
  for (const auto& [ends, faces] : faces_of) {
    if (faces.size() != 2)
      continue;
    const Eigen::Vector3d n = areaOf (mesh, mesh.faces[faces[0]]).normalized();
    const Eigen::Vector3d m = areaOf (mesh, mesh.faces[faces[1]]).normalized();
    const double angle = std::atan2 (n.cross (m).norm(), n.dot (m)) / DEGREE;
    if (angle <= LEAST_ANGLE)
      continue;
    const Eigen::Vector3d& a = mesh.vertices[ends.first];
    const bool convex = (middleOf (mesh, mesh.faces[faces[1]]) - a).dot (n) < 0.0;
    edges.push_back (
        {a,
         mesh.vertices[ends.second],
         convex ? pcl::crest::CrestType::RIDGE : pcl::crest::CrestType::VALLEY,
         angle});
  }
  return edges;
}

} // namespace

SharpObject
readSharpMesh (const std::string& file, std::string& error)
{
  SharpObject object;
  object.name = file.substr (file.find_last_of ('/') + 1);
  object.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  std::ifstream stream (file);
  Mesh mesh;
  if (file.size() > 4 && file.substr (file.size() - 4) == ".obj")
    readObj (stream, mesh);
  else
    readOff (stream, mesh);
  bool valid = !mesh.vertices.empty() && !mesh.faces.empty();
  for (const std::vector<std::size_t>& face : mesh.faces) {
    valid = valid && face.size() >= 3;
    for (const std::size_t vertex : face)
      valid = valid && vertex < mesh.vertices.size();
  }
  if (!valid) {
    error = "could not read vertices and faces from " + file;
    return object;
  }

  std::vector<Eigen::Vector3d> normals (mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const std::vector<std::size_t>& face : mesh.faces)
    for (const std::size_t vertex : face)
      normals[vertex] += areaOf (mesh, face);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = mesh.vertices[i].cast<float>();
    point.getNormalVector3fMap() = normals[i].normalized().cast<float>();
    object.cloud->push_back (point);
  }
  object.edges = sharpEdgesOf (mesh);
  return object;
}

} // namespace accuracy
