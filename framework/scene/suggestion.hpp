// "Did you mean": the nearest valid name to what was found.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trammel::scene {

// The candidate with the least edit distance (insert, delete, replace, swap neighbours), "" when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// `; known: a, b, c. Did you mean "b"?`, or without the question when nothing is near; "" without candidates. Of more
// than 24 names the 12 nearest are shown, and how many more there are.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trammel::scene
