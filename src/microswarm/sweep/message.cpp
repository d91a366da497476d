// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/message.hpp"

#include <cstring>

#include "microswarm/core/error.hpp"

namespace microswarm {
namespace {

class Packer {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  void put(const SqlValue& value) {
    put(static_cast<std::uint8_t>(value.index()));
    std::visit([this](const auto& held) { put_held(held); }, value);
  }
  std::string take() { return std::move(bytes_); }

 private:
  void put_held(std::monostate) {}
  template <class T>
  void put_held(const T& held) {
    put(held);
  }

  std::string bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T get() {
    T value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  /// A number of things, each at least a byte long.
  std::size_t count() {
    const auto n = get<std::uint64_t>();
    if (n > bytes_.size()) fail();
    return static_cast<std::size_t>(n);
  }
  std::string text() { return std::string(take(count())); }
  SqlValue value() {
    switch (get<std::uint8_t>()) {
      case 0:
        return std::monostate{};
      case 1:
        return get<std::int64_t>();
      case 2:
        return get<double>();
      case 3:
        return text();
      default:
        fail();
    }
  }
  void end() const {
    if (!bytes_.empty()) fail();
  }

 private:
  [[noreturn]] static void fail() { throw InputError("mpirun: a message that makes no sense"); }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) fail();
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }

  std::string_view bytes_;
};

}  // namespace

std::string to_bytes(const SweepMessage& message) {
  Packer packer;
  packer.put(message.kind);
  packer.put(message.text);
  packer.put(message.want);
  packer.put(static_cast<std::uint64_t>(message.tasks.size()));
  for (const SweepTask& task : message.tasks) packer.put(task);
  packer.put(static_cast<std::uint64_t>(message.rows.size()));
  for (const SweepRow& row : message.rows) {
    packer.put(row.task);
    packer.put(static_cast<std::uint64_t>(row.values.size()));
    for (const SqlValue& value : row.values) packer.put(value);
  }
  return packer.take();
}

SweepMessage message_of(std::string_view bytes) {
  Unpacker in(bytes);
  SweepMessage message;
  message.kind = in.get<SweepMessage::Kind>();
  message.text = in.text();
  message.want = in.get<std::uint32_t>();
  message.tasks.resize(in.count());
  for (SweepTask& task : message.tasks) task = in.get<SweepTask>();
  message.rows.resize(in.count());
  for (SweepRow& row : message.rows) {
    row.task = in.get<SweepTask>();
    row.values.resize(in.count());
    for (SqlValue& value : row.values) value = in.value();
  }
  in.end();
  return message;
}

}  // namespace microswarm
