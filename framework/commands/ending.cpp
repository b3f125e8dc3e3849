#include "commands/ending.hpp"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include <trammel/outside_domain.hpp>

#include "plugin/process/out_of_memory.hpp"
#include "run/run_failed.hpp"
#include "simulate/results/log_file.hpp"
#include "simulate/start/blame.hpp"

namespace trammel::simulate {
namespace {

using Cause = Ending::Cause;

Ending blamed(const plugin::PluginError& error) {
  return {Cause::other, error.what(), std::make_exception_ptr(error)};
}

bool has_expression(const scene::Value& value) {
  using Type = scene::Value::Type;
  if (value.type() == Type::text) return value.text().starts_with("=");
  if (value.type() == Type::array) return std::any_of(value.items().begin(), value.items().end(), has_expression);
  if (value.type() == Type::object)
    return std::any_of(value.members().begin(), value.members().end(),
                       [](const auto& member) { return has_expression(member.second); });
  return false;
}

// The scene is at fault if the component follows a law of time that the scene gives, such as sqrt(1-t), else the
// plugin.
Ending not_finite(const NotFinite& e, const scene::Value& root, const RunPoint& at) {
  const plugin::Origin& origin = *e.site().origin;
  const scene::Value* entry = root.at_path(origin.path);
  if (entry && has_expression(*entry))
    return {Cause::other,
            fmt::format("{}: {} ({} of {}) gave numbers that are not finite in its \"{}\"", e.what(), origin.path,
                        origin.component, origin.file, e.site().call),
            nullptr};
  return blamed(
      plugin::PluginError(origin, e.site().call, "it gave numbers that are not finite", at.t).in_step(at.step));
}

}  // namespace

Ending ending(const Setup& setup, const scene::Value& root, const RunPoint& at) {
  try {
    throw;
  } catch (const NotFinite& e) {
    return not_finite(e, root, at);
  } catch (const BadStep& e) {
    return blamed(plugin::PluginError(setup.integrator_origin, "step", e.what(), at.t).in_step(at.step));
  } catch (const RunFailed& e) {
    return {Cause::rows, e.what(), nullptr};
  } catch (const model::NotSolvable& e) {
    return {Cause::rows, at.words + e.what(), nullptr};
  } catch (const OutsideDomain& e) {
    return {Cause::other, at.words + said(e, at.call), nullptr};
  } catch (const OutputError& e) {
    return {Cause::output, e.what(), nullptr};
  } catch (const plugin::PluginError& e) {
    return blamed(e.step() || e.call().empty() ? e : e.in_step(at.step));
  } catch (const scene::SceneError& e) {
    return {Cause::scene, e.what(), std::current_exception()};
  } catch (const std::bad_alloc& e) {
    plugin::note_lack_of_memory();
    return {Cause::other, at.words + plugin::out_of_memory_message(e), nullptr};
  } catch (...) {
    return blamed(blame(setup, at.call, at.t, at.step));
  }
}

}  // namespace trammel::simulate
