// A joint's row that may have one sign only: gap = side g. It has no tangents for a friction law.
#include "system/contact_geometry/contact_geometry.hpp"
#include "system/markers/reaction_tangent.hpp"

namespace trammel::model {

namespace {

class RowLimitGap final : public ContactGeometry {
 public:
  RowLimitGap(const Model& model, const RowLimit& limit, MarkerMotions& markers)
      : limit_(limit), space_(model.world.space), markers_(markers) {
    for (const MarkerRef& marker : limit.markers) slots_.push_back(markers.slot(marker));
  }

  std::vector<int> slots() const override { return slots_; }
  CallSite call() const override { return {&limit_.origin, "rows"}; }

  void rows(const Point& at, Rows& rows) override {
    const std::size_t n = slots_.size();
    std::array<const Motion*, Rows::most_markers> motions{};
    for (std::size_t k = 0; k < n; ++k) motions[k] = &markers_.motion(slots_[k], at.t, at.q, at.v);
    rows.resize(1, space_, int(n));
    limit_.joint->rows_between(at.t, Motions(motions.data(), n), rows);
    if (limit_.side == 1) return;
    for (Vec6* each : {&rows.g, &rows.g_t, &rows.gamma}) *each *= limit_.side;
    for (int k = 0; k < int(n); ++k) rows.H(k) *= limit_.side;
  }

  void add_reaction_tangent(const Point& at, const Rows&, const Eigen::Vector3d& F, double c, Matrix& S) override {
    model::add_reaction_tangent({*limit_.joint, limit_.tangent, slots_, Vec6::Constant(1, limit_.side * F[0])},
                                markers_, at.t, at.q, at.v, c, S);
  }

  int tangents() const override { return dimension(space_) - 1; }

 private:
  const RowLimit& limit_;
  Space space_;
  MarkerMotions& markers_;
  std::vector<int> slots_;
};

}  // namespace

std::unique_ptr<ContactGeometry> row_limit(const Model& model, const ContactEntry& entry, MarkerMotions& markers) {
  return std::make_unique<RowLimitGap>(model, *entry.limit, markers);
}

}  // namespace trammel::model
