#include "plugin/guard.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>

#include <trammel/outside_domain.hpp>

#include "plugin/process/out_of_memory.hpp"

namespace trammel::plugin {

PassesThroughPlugins::~PassesThroughPlugins() = default;

void rethrow_as_plugin_error(const Origin& origin, const char* call, std::optional<double> t) {
  try {
    throw;
  } catch (const PluginError&) {
    throw;  // from another component, called through the System
  } catch (const PassesThroughPlugins&) {
    throw;
  } catch (const OutsideDomain&) {
    throw;  // an error of the scene
  } catch (const std::bad_alloc&) {
    note_lack_of_memory();
    throw;
  } catch (const std::exception& e) {
    throw PluginError(origin, call, fmt::format("it threw: {}", e.what()), t);
  } catch (...) {
    throw PluginError(origin, call, "it threw something that is no std::exception", t);
  }
}

void throw_not_finite(const Origin& origin, const char* call, double t, const char* what, Eigen::Index entry,
                      double value) {
  const std::string name = entry < 0 ? what : fmt::format("{}[{}]", what, entry);
  throw PluginError(origin, call, fmt::format("it returned {} = {}; expected a finite number", name, value), t);
}

}  // namespace trammel::plugin
