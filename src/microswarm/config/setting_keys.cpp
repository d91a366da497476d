// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/setting_keys.hpp"

#include <algorithm>
#include <map>

namespace microswarm {
namespace {

class Keys {
 public:
  void add_fields(const Type& record, const std::string& prefix) {
    for (const Field& field : record.fields) add(field, prefix + field.key);
  }

  std::vector<SettingKey> take() { return std::move(keys_); }

 private:
  void add(const Field& field, const std::string& key) {
    const Type& type = field.type->kind == TypeKind::optional ? *field.type->parts[0] : *field.type;
    if (type.kind == TypeKind::record) {
      add_fields(type, key + ".");
    } else if (type.kind == TypeKind::variant) {
      add_key(key + ".type", field.info.doc, type.words);
      for (const Type* alternative : type.parts) add_fields(*alternative, key + ".");
    } else if (type.kind == TypeKind::boolean) {
      add_key(key, field.info.doc, {"true", "false"});
    } else {
      add_key(key, field.info.doc, type.words);
    }
  }

  void add_key(const std::string& key, std::string_view doc,
               const std::vector<std::string_view>& words) {
    const auto [at, is_new] = indices_.try_emplace(key, keys_.size());
    if (is_new) keys_.push_back({key, doc, {}});
    std::vector<std::string_view>& all = keys_[at->second].words;
    for (const std::string_view word : words)
      if (std::find(all.begin(), all.end(), word) == all.end()) all.push_back(word);
  }

  std::vector<SettingKey> keys_;
  std::map<std::string, std::size_t> indices_;
};

}  // namespace

std::vector<SettingKey> setting_keys(const Type& type) {
  Keys keys;
  keys.add_fields(type, "");
  return keys.take();
}

}  // namespace microswarm
