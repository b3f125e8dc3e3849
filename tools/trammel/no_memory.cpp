#include "no_memory.hpp"

#include "last_words.hpp"
#include "plugin/out_of_memory.hpp"

namespace trammel::tool {

void watch_for_lack_of_memory() {
  std::set_new_handler([] { end_without_memory(std::bad_alloc()); });  // for aligned blocks
}

void end_without_memory(std::size_t asked_for) {
  end_without_memory(plugin::OutOfMemory(asked_for));
}

void end_without_memory(const std::bad_alloc& error) {
  Line line;
  line.add("{}", plugin::told(error));
  line.add_time(witness().culprit());
  end_process(Exit::failed, "failed", line);
}

}  // namespace trammel::tool
