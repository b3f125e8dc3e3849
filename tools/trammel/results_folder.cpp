#include "results_folder.hpp"

namespace trammel::tool {

namespace fs = std::filesystem;

fs::path results_folder(const Arguments& arguments, const char* ending) {
  if (arguments.has("--out")) return arguments.last("--out");
  fs::path name = fs::path(arguments.operand()).stem();
  return fs::path("out") / (name += ending);
}

}  // namespace trammel::tool
