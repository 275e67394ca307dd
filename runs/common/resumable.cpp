#include "runs/common/resumable.hpp"

#include <fmt/format.h>

#include "support/files.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

int resumably(const RunCommand& command, const std::function<int()>& work) {
  const std::string same =
      fmt::format("the same command{} goes on from there", command.fresh ? " without --fresh" : "");
  const Interrupted stopped(
      fmt::format("interrupted; what is finished is kept in {}: {}", command.out.string(), same));
  const auto explained = [&](const OutputError& error) {
    if (!error.noRoom) return error;
    return error.with(fmt::format("; what is finished is kept: make room, and {}", same));
  };
  try {
    return work();
  } catch (const Interrupted&) {
    throw stopped;
  } catch (const OutputError& error) {
    throw explained(error);
  } catch (const std::system_error& error) {
    throw explained(OutputError(error));
  } catch (const std::exception&) {
    // Ctrl-C goes to all programs of a terminal: what fails after it failed of it.
    if (interrupted()) throw stopped;
    throw;
  }
}

}  // namespace crossgrain::inline runs
