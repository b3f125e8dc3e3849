#include "no_memory.hpp"

#include "last_words.hpp"

namespace trammel::tool {

namespace {

// The missing block; global, because a handler has no other access. Null: an aligned block, whose operator new is the
// standard library's.
const plugin::OutOfMemory* noted = nullptr;

void end() {
  if (noted) end_without_memory(*noted);
  end_without_memory(std::bad_alloc());
}

}  // namespace

void watch_for_lack_of_memory() {
  std::set_new_handler(end);
}

void note_missing(const plugin::OutOfMemory& block) noexcept {
  noted = &block;
}

void end_without_memory(const std::bad_alloc& error) {
  Line line;
  line.add("{}", plugin::out_of_memory_message(error));
  line.add_time(witness().culprit());
  end_process(Exit::failed, "failed", line);
}

}  // namespace trammel::tool
