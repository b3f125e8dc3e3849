#include "tspline_plate/plate.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace trammel::plate {

Declaration joined_declaration() {
  return part<Joined>("joined", "two edges at which the surface goes on")
      .parameter("from", &Joined::from, {.required = true, .doc = "an edge, \"u1\", or \"roof.u1\" of a patch by name"})
      .parameter("to", &Joined::to, {.required = true, .doc = "the edge it meets"})
      .choice("continuity", &Joined::continuity, {{"C1", Continuity::C1}, {"C0", Continuity::C0}},
              {.doc = "C1: smooth, it carries bending moments; C0: a hinge along the edge"});
}

std::vector<FidelityParameter> TsplinePlate::fidelity() const {
  std::vector<FidelityParameter> all = {{"quadrature"}};
  const Patch& p = sole_patch;
  const bool numbered = !p.partial_lines.empty() || !p.crossed.empty() || !refine_elements.empty();
  if (!named_patches.empty() || numbered || !p.knots_u.empty() || !p.knots_v.empty()) return all;
  if (p.elements_u == 0 || p.elements_v == 0) all.push_back({"mesh.elements"});
  all.push_back({"mesh.elements_u"}), all.push_back({"mesh.elements_v"});
  return all;
}

std::string TsplinePlate::in_patch(int k) const {
  return named_patches.empty() ? "" : named_patches[std::size_t(k)].first + ".";
}

namespace {

// Rethrows a patch's ParameterError with the name of the parameter in the plate.
template <class Call>
auto of_patch(const std::string& prefix, Call call) {
  try {
    return call();
  } catch (const ParameterError& e) {
    throw ParameterError(prefix + e.parameter(), e.what());
  }
}

std::string parameters_of(const std::string& in_patch) {
  return in_patch.empty() ? "" : "patches." + in_patch;
}

}  // namespace

PatchEdge TsplinePlate::edge_named(const std::string& name) const {
  for (int k = 0; k < patch_count(); ++k)
    for (std::size_t e = 0; e < 4; ++e)
      if (name == in_patch(k) + edge_names[e]) return {k, edges[e], name};
  std::string patches;
  for (const auto& [patch, unused] : named_patches) patches += (patches.empty() ? "" : ", ") + patch;
  throw std::invalid_argument(
      fmt::format("no edge \"{}\"; expected {}u0, u1, v0 or v1{}", name,
                  named_patches.empty() ? "" : "a patch and an edge, as in \"" + in_patch(0) + "u1\": ",
                  patches.empty() ? "" : ", of " + patches));
}

void TsplinePlate::check_parameters(const World& world) const {
  if (world.space != Space::spatial)
    throw ParameterError("type", "tspline_plate moves in space; set \"space\": \"spatial\"");
  if (!named_patches.empty())
    if (const std::string own = first_given(sole_patch); !own.empty())
      throw ParameterError(own, "the plate has \"patches\"; say it in one of them");
  for (const auto& [name, unused] : named_patches)
    if (name.empty() || name.find('.') != name.npos)
      throw ParameterError("patches", fmt::format("found the name \"{}\", expected one without a dot", name));
  for (int k = 0; k < patch_count(); ++k) of_patch(parameters_of(in_patch(k)), [&] { given(k).check(); });
  if (!held_axes.empty() && axes_in(held_axes).empty())
    throw ParameterError("held_axes", fmt::format("found \"{}\", expected axes such as \"z\" or \"xy\"", held_axes));
  check_joined();
  check_refinement();
}

namespace {

// Patches that are joined, directly or through others, have the same number in `group`.
void require_one_group(const std::vector<int>& group, const Named<Patch>& patches) {
  for (std::size_t k = 1; k < group.size(); ++k)
    if (group[k] != group[0])
      throw ParameterError(
          "patches." + patches[k].first,
          fmt::format("nothing in \"joined\" ties it to {}; a separate plate is a body of its own", patches[0].first));
}

}  // namespace

// Every patch is connected to the first, and an edge continues smoothly in one other edge at most.
void TsplinePlate::check_joined() const {
  std::vector<int> group;
  for (int k = 0; k < patch_count(); ++k) group.push_back(k);
  std::vector<std::string> smooth;
  for (const auto& [name, ends] : joined) {
    const std::string parameter = "joined." + name;
    std::array<PatchEdge, 2> sides;
    try {
      sides = {edge_named(ends.from), edge_named(ends.to)};
    } catch (const std::invalid_argument& e) {
      throw ParameterError(parameter, e.what());
    }
    if (ends.from == ends.to) throw ParameterError(parameter, fmt::format("{} is joined to itself", ends.from));
    for (const PatchEdge& side : sides) {
      const auto edge = std::size_t(2 * side.edge.direction + side.edge.high);
      if (const std::string& condition = given(side.patch).edge_condition(edge); condition != "free")
        throw ParameterError(parameter,
                             fmt::format("{} is joined and \"{}\" as well; leave it free", side.name, condition));
      if (ends.continuity == Continuity::C0) continue;
      if (std::find(smooth.begin(), smooth.end(), side.name) != smooth.end())
        throw ParameterError(parameter,
                             fmt::format("{} is joined C1 twice; it can go on smoothly in one edge", side.name));
      smooth.push_back(side.name);
    }
    const int from = group[std::size_t(sides[0].patch)], to = group[std::size_t(sides[1].patch)];
    std::replace(group.begin(), group.end(), to, from);
  }
  require_one_group(group, named_patches);
}

void TsplinePlate::check_refinement() const {
  const bool on_contact = !refine_on.empty(), by_indicator = indicator != Indicator::none;
  if (on_contact + refine_at.has_value() + by_indicator > 1)
    throw ParameterError(refine_at ? "refine.at" : "refine.indicator", "give one of on_contact, at, indicator");
  if (by_indicator && !refine_threshold)
    throw ParameterError("refine.threshold", "an indicator needs the value above which an element is split");
  if (refine_near && !on_contact) throw ParameterError("refine.near", "it belongs to refine.on_contact");
  if (!refine_elements.empty() && chooses_elements())
    throw ParameterError("refine.elements", "the elements are chosen by near or by the indicator; leave them out");
  if ((on_contact || refine_at) && refine_elements.empty() && !refine_near)
    throw ParameterError("refine.elements", "name the elements to split, counted by rows from 0");
}

// Side by side in the plane of parameters, 1 apart.
std::vector<ControlNet> TsplinePlate::first_nets() const {
  std::vector<ControlNet> nets;
  for (int k = 0; k < patch_count(); ++k) {
    ControlNet net = of_patch(parameters_of(in_patch(k)), [&] { return given(k).net(); });
    if (k > 0) net.mesh.shift(nets.back().mesh.knots(0).back() + 1 - net.mesh.knots(0).front());
    nets.push_back(std::move(net));
  }
  return nets;
}

void TsplinePlate::hold(const Discretisation& mesh, Elimination& e) {
  for (int axis : axes_in(held_axes))
    for (int i = 0; i < mesh.basis.size(); ++i) e.hold(3 * i + axis);
  std::vector<Seam> seams;
  for (const auto& [name, ends] : joined) try {
      seams.push_back(find_seam(mesh.basis, mesh.points, edge_named(ends.from), edge_named(ends.to), ends.continuity));
      join(mesh.basis, mesh.points, seams.back(), e);
    } catch (const std::invalid_argument& error) {
      throw ParameterError("joined." + name, error.what());
    }
  seams_ = std::move(seams);
  for (int k = 0; k < patch_count(); ++k) {
    const PatchNet net{mesh.basis.patch(k), mesh.points, mesh.basis.first_function(k)};
    const auto held = [&](const std::string& parameter, auto call) {
      try {
        call();
      } catch (const std::invalid_argument& error) {
        throw ParameterError(parameters_of(in_patch(k)) + parameter, error.what());
      }
    };
    for (std::size_t c = 0; c < 4; ++c)
      held(fmt::format("corners.{}", corners[c].name),
           [&] { hold_corner(net, corners[c], given(k).corner_condition(c), e); });
    for (std::size_t c = 0; c < 4; ++c)
      held(fmt::format("edges.{}", edge_names[c]), [&] { hold_edge(net, edges[c], given(k).edge_condition(c), e); });
  }
}

void TsplinePlate::take(const std::vector<ControlNet>& nets) {
  const PlateData data{{thickness, youngs_modulus, poissons_ratio}, density, quadrature};
  mesh_ = std::make_unique<Discretisation>(nets, data,
                                           [this](const Discretisation& mesh, Elimination& e) { hold(mesh, e); });
  moment_edges_.clear();
  for (int k = 0; k < patch_count(); ++k)
    for (std::size_t edge = 0; edge < 4; ++edge)
      if (given(k).has_edge_moment(edge)) moment_edges_.push_back({k, edge, edge_points(*mesh_, k, edges[edge])});
  gather_dead_loads();
  place_markers();
  if (chooses_elements()) splittable_ = Splittable(mesh_->basis, first_elements_, refine_levels);
}

void TsplinePlate::gather_dead_loads() {
  const int n = mesh_->basis.size();
  Vec on_weight(3 * n), on_dead(3 * n);
  for (int i = 0; i < n; ++i) {
    on_weight.segment<3>(3 * i) = mesh_->lumped(i) * gravity_;
    on_dead.segment<3>(3 * i) = mesh_->area(i) * Vector3(load);
  }
  for (int k = 0; k < patch_count(); ++k)
    for (std::size_t edge = 0; edge < 4; ++edge) {
      if (!given(k).has_edge_load(edge)) continue;
      for (const EdgePoint& p : edge_points(*mesh_, k, edges[edge])) {
        const Vector3 line_load = given(k).edge_load(edge, p.outward);
        const auto& nodes = mesh_->cells[std::size_t(p.point.cell)].nodes;
        for (std::size_t f = 0; f < nodes.size(); ++f)
          on_dead.segment<3>(3 * nodes[f]) += p.length * p.point.shape.R(Eigen::Index(f)) * line_load;
      }
    }
  weight_force_ = dead_force_ = Vec::Zero(mesh_->coordinates.coordinates());
  mesh_->coordinates.restrict(on_weight, weight_force_);
  mesh_->coordinates.restrict(on_dead, dead_force_);
}

void TsplinePlate::place_markers() {
  for (Marker& m : marker_points_) m.point = surface_point(*mesh_, m.u, m.v, m.height);
}

// Markers are given in the parameters of their patch, whose u begins at `own_u`.
void TsplinePlate::add_markers(int k, const Box<double>& range, double own_u) {
  const auto& [low, high] = range;
  const std::string prefix = named_patches.empty() ? "" : named_patches[std::size_t(k)].first + "_";
  const auto add = [&](const std::string& name, double u, double v, double height) {
    marker_names_.push_back(prefix + name);
    marker_points_.push_back({u, v, height, {}});
  };
  add("centre", (low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0);
  for (const Corner& c : corners)
    add(c.name, edges[c.u_edge].high ? high[0] : low[0], edges[c.v_edge].high ? high[1] : low[1], 0);
  const std::string parameter = parameters_of(in_patch(k)) + "markers";
  const double last_u = own_u + high[0] - low[0];
  for (const auto& [name, at] : given(k).markers) {
    if (!(at(0) >= own_u && at(0) <= last_u && at(1) >= low[1] && at(1) <= high[1]))
      throw ParameterError(
          parameter, fmt::format("\"{}\" is at (u, v) = ({}, {}), expected u from {} to {}, v from {} to {}", name,
                                 at(0), at(1), own_u, last_u, low[1], high[1]));
    if (std::find(marker_names_.begin(), marker_names_.end(), prefix + name) != marker_names_.end())
      throw ParameterError(parameter, fmt::format("\"{}\" exists already", name));
    add(name, std::min(low[0] + (at(0) - own_u), high[0]), at(1), at(2));
  }
}

void TsplinePlate::prepare(const World& world) {
  check_parameters(world);
  gravity_ = world.gravity;
  const std::vector<ControlNet> nets = first_nets();
  first_elements_.clear(), marker_names_.clear(), marker_points_.clear();
  for (int k = 0; k < patch_count(); ++k) {
    const TMesh& mesh = nets[std::size_t(k)].mesh;
    for (const Box<int>& element : mesh.elements()) first_elements_.push_back(mesh.parameters(element));
    const auto &u = mesh.knots(0), &v = mesh.knots(1);
    add_markers(k, {{u.front(), v.front()}, {u.back(), v.back()}},
                given(k).knots_u.empty() ? 0 : given(k).knots_u.front());
  }
  check_elements("refine.elements", refine_elements, first_elements_.size());
  observable_names_ = {"von_mises_top",   "von_mises_middle", "von_mises_bottom",
                       "energy_membrane", "energy_bending",   "elements"};
  for (const std::string& name : marker_names_)
    for (const char* face : {"top", "middle", "bottom"})
      observable_names_.push_back(fmt::format("von_mises_{}_{}", face, name));
  try {
    take(nets);
  } catch (const std::invalid_argument& e) {
    throw ParameterError("geometry", e.what());
  }
}

void TsplinePlate::initial(Out q, Out v) const {
  q.setZero();
  const Vector3 about = given(0).origin;
  const auto& kept = mesh_->coordinates.kept();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Vector3 arm = Vector3(mesh_->points.row(kept[k] / 3)) - about;
    v(Eigen::Index(k)) = (Vector3(velocity) + Vector3(angular_velocity).cross(arm))(kept[k] % 3);
  }
}

}  // namespace trammel::plate
