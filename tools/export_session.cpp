// SPDX-License-Identifier: BSD-3-Clause
#include "export_session.h"

#include <pcl_crest/io/write_labels.h>
#include <pcl_crest/io/write_lines.h>
#include <pcl_crest/io/write_statistics.h>

#include "command_line.h"
#include "io/output_file.h"

namespace pcl {
namespace crest {

namespace {

constexpr char LABELS[] = "_labels.pcd";
constexpr char LINES[] = "_lines.ply";
constexpr char STATISTICS[] = "_statistics.json";
constexpr char COMMAND[] = "_command.txt";

} // namespace

std::vector<std::string>
exportSuffixes ()
{
  return {LABELS, LINES, STATISTICS, COMMAND};
}

bool
exportSession (const CrestSession& session,
               const std::string& input,
               const std::string& prefix,
               std::string& error)
{
  const InputCloud& cloud = session.getCloud();
  const pcl::PointCloud<pcl::Label>& labels = session.getLabels();
  const std::string labels_file = prefix + LABELS;
  const std::string lines_file = prefix + LINES;
  const std::string statistics_file = prefix + STATISTICS;
  const std::string command =
      "pcl_crest_line_estimation " + quoted (input) + " " + quoted (labels_file) +
      " -lines " + quoted (lines_file) + " -stats " + quoted (statistics_file) +
      optionsOf (cloud) + optionsOf (session.getParameters()) + "\n";
  OutputGroup outputs;
  return writeLabels (labels_file,
                      cloud,
                      labels,
                      session.getCurvatures(),
                      session.getLines(),
                      error) &&
         writeLines (lines_file,
                     session.getLineCloud(),
                     session.getLines(),
                     error,
                     cloud.placement) &&
         writeStatistics (statistics_file,
                          cloud,
                          labels,
                          session.getParameters(),
                          session.getLines(),
                          session.getStatistics(),
                          session.getStatistics().times,
                          error) &&
         replaceFile (prefix + COMMAND, command, error) && outputs.commit (error);
}

} // namespace crest
} // namespace pcl
