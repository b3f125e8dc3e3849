#include "scene/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <span>
#include <utility>

#include "scene/shortened.hpp"

namespace trammel::scene {

namespace {

// Suggestions are limited to shorter words and fewer names, which bounds the cost of hostile input.
constexpr std::size_t longest = 200, most = 1000;

std::span<const std::string> compared(const std::vector<std::string>& candidates) {
  return std::span(candidates).first(std::min(most, candidates.size()));
}

char lower(char c) {
  return char(std::tolower(static_cast<unsigned char>(c)));
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

// Optimal string alignment distance; case differences count half, so "HHT_alpha" is nearest to "hht_alpha".
double distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<double> before(n + 1), previous(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) previous[j] = double(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = double(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const double replace = a[i - 1] == b[j - 1] ? 0 : lower(a[i - 1]) == lower(b[j - 1]) ? 0.5 : 1;
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, row);
  }
  return previous[n];
}

// The whole list if it is short, else the nearest names.
std::vector<std::string> worth_showing(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t glance = 24, few = 12;
  if (candidates.size() <= glance) return candidates;
  std::vector<std::pair<double, const std::string*>> ranked;
  for (const std::string& candidate : compared(candidates))
    ranked.emplace_back(distance(word.substr(0, longest), std::string_view(candidate).substr(0, longest)), &candidate);
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < few; ++i) shown.push_back(*ranked[i].second);
  return shown;
}

// The shortest candidate that starts with the word: "hht_alpha" for "hht".
std::string begun_with(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t least = 2;
  if (word.size() < least) return {};
  std::string found;
  for (const std::string& candidate : candidates)
    if (same_letters(word, std::string_view(candidate).substr(0, word.size())) &&
        (found.empty() || candidate.size() < found.size()))
      found = candidate;
  return found;
}

// The shortest candidate that has the word as its last part: "rod.pin" for "pin".
std::string ended_with(std::string_view word, const std::vector<std::string>& candidates) {
  std::string found;
  for (const std::string& candidate : candidates)
    if (candidate.size() > word.size() + 1 && candidate[candidate.size() - word.size() - 1] == '.' &&
        same_letters(word, std::string_view(candidate).substr(candidate.size() - word.size())) &&
        (found.empty() || candidate.size() < found.size()))
      found = candidate;
  return found;
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() > longest) return {};
  double best = std::numeric_limits<double>::infinity();
  std::string found;
  for (const std::string& candidate : compared(candidates)) {
    if (candidate.size() > longest) continue;
    const double d = distance(word, candidate);
    if (d < best) best = d, found = candidate;
  }
  // At most half of a short word or a third of a long one may differ: "foo" does not suggest "cos".
  const double size = double(std::max(word.size(), found.size()));
  const double near = std::min(std::max(2.0, size / 3), size / 2);
  if (best <= near && best < double(word.size())) return found;
  const std::string begun = begun_with(word, candidates);
  return begun.empty() && !word.empty() ? ended_with(word, candidates) : begun;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return {};
  const std::vector<std::string> shown = worth_showing(word, candidates);
  std::string text = "; known: ";
  for (std::size_t i = 0; i < shown.size(); ++i) text += (i ? ", " : "") + shortened(shown[i]);
  if (shown.size() < candidates.size()) text += " and " + std::to_string(candidates.size() - shown.size()) + " more";
  const std::string guess = nearest(word, candidates);
  if (!guess.empty()) text += ". Did you mean \"" + guess + "\"?";
  return text;
}

}  // namespace trammel::scene
