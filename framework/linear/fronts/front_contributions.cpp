#include "linear/fronts/front_contributions.hpp"

#include <algorithm>

#include "linear/dense/prefetch.hpp"

namespace trammel::numerics {

namespace {

using Source = FrontLayout::Source;

bool is_mass(const Source& source) {
  return source.row < 0;
}

std::size_t count(const Source& source) {
  return std::size_t(is_mass(source) ? source.size * source.size : source.size);
}

const double* in_body(const Source& source, const std::vector<BodyBlock>& bodies) {
  const BodyBlock& body = bodies[std::size_t(source.body)];
  return is_mass(source) ? body.M.data() : body.Gt.data() + source.column * source.size;
}

}  // namespace

void FrontContributions::build(const FrontLayout& layout, const std::vector<BodyBlock>& bodies) {
  places_.assign(layout.sources().size(), 0);
  fronts_.clear();
  std::size_t changing = 0, i = 0;
  for (const FrontLayout::Front& front : layout.fronts()) {
    fronts_.push_back(changing);
    for (; i < std::size_t(front.masses.end); ++i) {
      if (layout.sources()[i].constant) continue;
      places_[i] = int(changing);
      changing += count(layout.sources()[i]);
    }
  }
  fronts_.push_back(changing);
  numbers_.assign(changing, 0);
  Known known;
  for (i = 0; i < places_.size(); ++i)
    if (const Source& source = layout.sources()[i]; source.constant && !is_mass(source))
      places_[i] = place(in_body(source, bodies), count(source), known);
  masses_placed_ = false;
}

void FrontContributions::place_masses(const FrontLayout& layout, const std::vector<BodyBlock>& bodies) {
  if (masses_placed_) return;
  Known known;
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (const Source& source = layout.sources()[i]; source.constant && is_mass(source))
      places_[i] = place(in_body(source, bodies), count(source), known);
  masses_placed_ = true;
}

int FrontContributions::place(const double* numbers, std::size_t count, Known& known) {
  const std::string bytes(reinterpret_cast<const char*>(numbers), count * sizeof(double));
  const auto [found, is_new] = known.try_emplace(bytes, int(numbers_.size()));
  if (is_new) numbers_.insert(numbers_.end(), numbers, numbers + count);
  return found->second;
}

const double* FrontContributions::update(std::size_t i, const Source& source, const std::vector<BodyBlock>& bodies) {
  if (!source.constant) std::copy_n(in_body(source, bodies), count(source), numbers_.data() + places_[i]);
  return of(i);
}

void FrontContributions::prefetch(std::size_t front) const {
  numerics::prefetch(numbers_.data() + fronts_[front], (fronts_[front + 1] - fronts_[front]) * sizeof(double));
}

}  // namespace trammel::numerics
