// State that must survive a checkpoint. One function both writes and reads it:
//
//     void archive(Archive& a) override { a("history", history_); a("filled", filled_); }
//
// A value that is read equals bit for bit the value that was written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <trammel/types.hpp>

namespace trammel {

class Archive {
 public:
  virtual ~Archive();
  virtual void operator()(std::string_view name, bool&) = 0;
  virtual void operator()(std::string_view name, int&) = 0;
  virtual void operator()(std::string_view name, long long&) = 0;
  virtual void operator()(std::string_view name, double&) = 0;
  virtual void operator()(std::string_view name, std::string&) = 0;
  virtual void operator()(std::string_view name, Vec&) = 0;

  void operator()(std::string_view name, std::vector<Vec>& values);

 protected:
  Archive() = default;
  Archive(const Archive&) = default;
  Archive& operator=(const Archive&) = default;
};

}  // namespace trammel
