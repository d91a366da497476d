// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/results/metrics_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "microswarm/config/write.hpp"
#include "microswarm/io/columns.hpp"

namespace microswarm::experiment {

using Json = nlohmann::ordered_json;

Json metrics_json(const Metrics& metrics) {
  Json all = Json::object();
  for (const io::Column& column : io::to_columns<Metrics>()) {
    if (column.kind == io::ColumnKind::integer)
      all[column.key] = column.integer(&metrics);
    else if (const double value = column.number(&metrics); std::isfinite(value))
      all[column.key] = value;
    else
      all[column.key] = nullptr;
  }
  return all;
}

Json metrics_json_with_former_names(const Metrics& metrics) {
  Json all = metrics_json(metrics);
  const Json former = Json::parse(to_json_text(metrics));
  for (const auto& [name, value] : former.items())
    if (!all.contains(name)) all[name] = value;
  return all;
}

}  // namespace microswarm::experiment
