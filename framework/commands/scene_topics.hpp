// Manual pages of the scene language itself: `trammel describe scene`, `expressions`, `for`, `table`, `markers`, ...
#pragma once

#include <string>
#include <vector>

#include "plugin/registry.hpp"

namespace trammel::simulate {

struct Topic {
  std::string name, summary;  // the summary is one line of `trammel list --all`
  std::string page;
};

// Lists in the pages (functions, kinds of events, markers of each body) are generated from the program's own tables.
std::vector<Topic> scene_topics(const std::vector<const plugin::Entry*>& components);

}  // namespace trammel::simulate
