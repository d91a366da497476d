// SPDX-License-Identifier: Apache-2.0
#include "rig/commissioner.hpp"

#include <pwd.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "support/cli.hpp"

namespace microswarm::cli {

void add_by(Command cmd, std::string& by) {
  cmd.add_option("--by", by, "Person in the commissioning record")
      .type_name("NAME")
      .default_text("the user");
}

std::string commissioner(const std::string& by) {
  if (!by.empty()) return by;
  const passwd* const user = ::getpwuid(::geteuid());
  return user ? user->pw_name : std::to_string(::geteuid());
}

void commission(const std::filesystem::path& rig_file,
                const std::vector<rig::CommissioningEntry>& entries) {
  if (entries.empty()) return;
  rig::add_to_commissioning(rig_file, entries);
  std::string names;
  for (const rig::CommissioningEntry& entry : entries)
    names += (names.empty() ? "" : ", ") + std::string(enum_name(entry.what));
  note("note: {} in {}, by {}\n", names, rig::commissioning_file(rig_file).string(),
       entries.front().by);
}

nlohmann::ordered_json commissioning_json(const rig::CommissioningState& state) {
  using Json = nlohmann::ordered_json;
  const auto list = [](const std::vector<rig::CommissioningEntry>& entries) {
    Json all = Json::array();
    for (const rig::CommissioningEntry& entry : entries)
      all.push_back({{"what", enum_name(entry.what)},
                     {"value", entry.value},
                     {"date", entry.date},
                     {"by", entry.by}});
    return all;
  };
  Json missing = Json::array();
  for (const rig::Quantity what : state.missing) missing.push_back(enum_name(what));
  return {{"complete", state.complete()},
          {"measured", list(state.valid)},
          {"stale", list(state.stale)},
          {"missing", missing}};
}

}  // namespace microswarm::cli
