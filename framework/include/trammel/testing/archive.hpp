// An archive in memory, for tests of components that archive a history.
#pragma once

#include <map>
#include <string>

#include <trammel/archive.hpp>

namespace trammel {

class MemoryArchive final : public Archive {
 public:
  bool reading = false;
  std::map<std::string, Vec, std::less<>> vectors;  // for tests that look at a method's history

  using Archive::operator();
  void operator()(std::string_view name, bool& x) override { exchange(bools_, name, x); }
  void operator()(std::string_view name, int& x) override { exchange(ints_, name, x); }
  void operator()(std::string_view name, long long& x) override { exchange(longs_, name, x); }
  void operator()(std::string_view name, double& x) override { exchange(doubles_, name, x); }
  void operator()(std::string_view name, std::string& x) override { exchange(texts_, name, x); }
  void operator()(std::string_view name, Vec& x) override { exchange(vectors, name, x); }

 private:
  template <class T>
  using Kept = std::map<std::string, T, std::less<>>;
  template <class T>
  void exchange(Kept<T>& kept, std::string_view name, T& x) {
    if (reading)
      x = kept.at(std::string(name));
    else
      kept[std::string(name)] = x;
  }
  Kept<bool> bools_;
  Kept<int> ints_;
  Kept<long long> longs_;
  Kept<double> doubles_;
  Kept<std::string> texts_;
};

}  // namespace trammel
