#include "version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "input.hpp"
#include "simulate/results/provenance.hpp"

namespace trammel::tool {

void print_version(bool as_json) {
  if (!as_json) {
    fmt::print("trammel {}\n", simulate::build_info().version);
    return;
  }
  nlohmann::ordered_json object = {{"status", "done"}};
  object.update(simulate::program_json());
  plugin::Registry registry;
  std::vector<plugin::Identity> libraries;
  registry.all();
  for (const std::string& file : registry.files()) libraries.push_back(plugin::identify(file));
  object["plugins"] = simulate::libraries_json(libraries);
  print_json(object);
}

}  // namespace trammel::tool
