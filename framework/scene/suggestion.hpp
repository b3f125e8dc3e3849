// "Did you mean": the valid name that is nearest to the one found.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trammel::scene {

// The candidate with the least edit distance (insert, delete, replace, swap neighbours), or "" if none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// `; known: a, b, c. Did you mean "b"?`, without the question if none is near; "" without candidates. Of more than 24
// names, the 12 nearest are shown with the number of the others.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trammel::scene
