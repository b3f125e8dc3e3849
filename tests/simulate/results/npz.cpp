#include "simulate/results/npz.hpp"

#include <gtest/gtest.h>

#include "simulate/results/log_file.hpp"
#include "support/run_scene.hpp"

namespace trammel::simulate {
namespace {

// As NumPy's own reader judges: names, shapes, values, and zipfile's checksums.
const char* const reader = R"(
import sys, zipfile
assert zipfile.ZipFile(sys.argv[1]).testzip() is None
try:
    import numpy
except ImportError:
    sys.exit(0)
z = numpy.load(sys.argv[1])
assert z.files == ["t", "n", "names"], z.files
assert z["t"].shape == (3, 2) and z["t"].dtype == "f8" and z["t"][2, 1] == 0.1, z["t"]
assert z["n"].tolist() == [-1, 9007199254740993], z["n"]
assert z["names"].tolist() == ["a", "größer"], z["names"]
)";

TEST(NpzFile, IsReadByPython) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path());
  const std::filesystem::path file = folder.path() / "x.npz", script = folder.path() / "read.py";
  NpzFile npz(file);
  const std::vector<double> t = {1, 2, 3, 4, 5, 0.1};
  const std::vector<std::int64_t> n = {-1, 9007199254740993};
  const std::vector<std::string> names = {"a", "größer"};
  npz.add("t", {3, 2}, t), npz.add("n", {2}, n), npz.add("names", names);
  npz.close();
  std::ofstream(script) << reader;
  EXPECT_EQ(std::system(("/usr/bin/python3 '" + script.string() + "' '" + file.string() + "'").c_str()), 0);
}

TEST(NpzFile, RefusesAShapeOfAnotherSize) {
  const std::vector<double> t(5);
  EXPECT_THROW(NpzFile("x.npz").add("t", {2, 3}, t), std::length_error);
}

}  // namespace
}  // namespace trammel::simulate
