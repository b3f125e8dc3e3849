// The n-th allocation fails, for every n: a scene is read, or std::bad_alloc comes out; and what was made till then is
// freed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string>

#include "scene/value.hpp"

namespace {

long long left = -1;  // allocations before one fails; negative: none does
long long held = 0;   // not freed

void* allocate(std::size_t size) {
  if (left >= 0 && left-- == 0) throw std::bad_alloc();
  void* p = std::malloc(size > 0 ? size : 1);
  if (!p) throw std::bad_alloc();
  ++held;
  return p;
}

void release(void* p) noexcept {
  if (p) --held;
  std::free(p);
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* p) noexcept {
  release(p);
}
void operator delete[](void* p) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t) noexcept {
  release(p);
}
void operator delete[](void* p, std::size_t) noexcept {
  release(p);
}

namespace trammel::scene {
namespace {

// Texts longer than what a string holds in place, numbers, nothing, arrays, objects, parameters of both kinds, repeated
// units.
const std::string text = R"({"trammel": 1, "title": "a title that is longer than a short string",
  "parameters": {"n": 3, "length": "=2*pi*n", "name": "a parameter that is longer than a short string"},
  "bodies": {"bar_{i}_with_a_long_name": {"for": {"i": "=n"}, "type": "bar", "from": ["={i}*length", 0], "to": [1, 2.5],
                                          "title": "=name", "on": true, "nothing": null}},
  "joints": {"a": {"between": ["ground", "bar_{1}_with_a_long_name.from"]}}})";

// Calls until no allocation of it fails. Returns how many did.
template <class Call>
int fail_each(Call call) {
  for (int n = 0;; ++n) {
    const long long before = held;
    left = n;
    bool failed = false;
    try {
      call();
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    const bool all = left >= 0;
    left = -1;
    EXPECT_EQ(held, before) << "allocation " << n;
    if (!failed && all) return n;
  }
}

TEST(OutOfMemory, EndsTheReadingOfASceneAtAnyAllocation) {
  static_cast<void>(Scene::parse(text, "test.json"));  // what is made once
  EXPECT_GT(fail_each([] { static_cast<void>(Scene::parse(text, "test.json")); }), 300);
}

TEST(OutOfMemory, EndsTheCopyOfAValueAtAnyAllocation) {
  const Scene scene = Scene::parse(text, "test.json");
  EXPECT_GT(fail_each([&] {
              Value copy = scene.root();
              copy = scene.root().at_path("bodies") ? *scene.root().at_path("bodies") : copy;
            }),
            30);
}

}  // namespace
}  // namespace trammel::scene
