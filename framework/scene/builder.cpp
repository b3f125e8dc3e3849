#include "scene/builder.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "scene/fnv_hash.hpp"
#include "scene/limits.hpp"

namespace trammel::scene {

Value Builder::make(Content content, const Position& at) {
  Value value;
  value.content_ = std::move(content);
  value.siblings_ = std::make_shared<const Value::Siblings>(Value::Siblings{at.file, "", nullptr});
  value.line_ = at.line, value.column_ = at.column;
  return value;
}

Value Builder::make(Content content, const Value& in_file, int line, int column) {
  Value value;
  value.content_ = std::move(content);
  value.siblings_ = in_file.siblings_;
  value.line_ = line, value.column_ = column;
  return value;
}

void Builder::place(Value& value, const Value& at) {
  value.siblings_ = at.siblings_;
  value.line_ = at.line_, value.column_ = at.column_;
}

Value Builder::like(const Value& other, Content content) {
  Value value = other;
  value.content_ = std::move(content);
  value.by_name_.reset();
  return value;
}

Value* Builder::find(Value& object, std::string_view key) {
  return const_cast<Value*>(std::as_const(object).find(key));
}

namespace {

// A long text takes the memory of several values.
std::size_t excess(std::size_t bytes) {
  return bytes / limits::bytes_of_a_value;
}

}  // namespace

std::size_t Builder::size(const Value& value) {
  std::size_t sum = 1 + excess(value.file().size());
  if (value.type() == Value::Type::text) {
    const std::string& text = value.text();
    sum += excess(text.size()) + std::size_t(std::count(text.begin(), text.end(), '{'));
  } else if (value.type() == Value::Type::array) {
    for (const Value& item : value.items()) sum += size(item);
  } else if (value.type() == Value::Type::object) {
    for (const auto& [name, member] : value.members()) sum += excess(name.size()) + size(member);
  }
  return sum;
}

void Builder::finish(Value& value, const std::string& path,
                     const std::shared_ptr<const Value::Parameters>& parameters) {
  std::size_t sum = 0;
  std::shared_ptr<const Value::Siblings> alone;
  finish(value, {"", parameters}, path, alone, sum);
}

// `siblings`: those of the previous value; they are shared if both values are in the same file.
void Builder::finish(Value& value, const Family& family, std::string name,
                     std::shared_ptr<const Value::Siblings>& siblings, std::size_t& size) {
  if (!siblings || siblings->file != value.file())
    siblings = std::make_shared<const Value::Siblings>(Value::Siblings{value.file(), family.path, family.parameters});
  value.siblings_ = siblings;
  value.name_ = std::move(name);
  const Family own{value.path(), family.parameters};
  size += 1 + excess(own.path.size()) + excess(value.file().size());
  if (size > limits::values)
    throw SceneError({value.problem(fmt::format(
        "the scene grows beyond {} values here; long names and deep nesting count as more", limits::values))});
  std::shared_ptr<const Value::Siblings> of_children;
  if (value.type() == Value::Type::array) {
    int i = 0;
    for (Value& item : items(value)) finish(item, own, fmt::format("[{}]", i++), of_children, size);
  } else if (value.type() == Value::Type::object) {
    for (auto& [key, member] : members(value)) finish(member, own, key, of_children, size);
    order_by_name(value);
  }
}

void Builder::order_by_name(Value& object) {
  constexpr std::size_t large = 64;  // the index does not speed up smaller objects
  const Members& members = object.members();
  if (members.size() < large) return;
  std::vector<int> order(members.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return members[std::size_t(a)].first < members[std::size_t(b)].first; });
  object.by_name_ = std::make_shared<const std::vector<int>>(std::move(order));
}

std::uint64_t Builder::hash(const Value& value) {
  FnvHash h;
  h.number(int(value.type()));
  switch (value.type()) {
    case Value::Type::null:
      break;
    case Value::Type::boolean:
      h.number(value.boolean());
      break;
    case Value::Type::number:
      h.number(std::get<double>(value.content_) + 0.0);
      break;  // -0 is 0
    case Value::Type::text:
      h.text(value.text());
      break;
    case Value::Type::array:
      for (const Value& item : value.items()) h.number(hash(item));
      break;
    case Value::Type::object: {
      std::vector<std::uint64_t> each;
      for (const auto& [name, member] : value.members()) {
        FnvHash pair;
        pair.text(name);
        pair.number(hash(member));
        each.push_back(pair.value());
      }
      std::sort(each.begin(), each.end());
      for (const std::uint64_t x : each) h.number(x);
    }
  }
  return h.value();
}

}  // namespace trammel::scene
