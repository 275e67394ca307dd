#include <fcntl.h>
#include <fmt/format.h>
#include <gsl/gsl_errno.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "adapters/engine.hpp"
#include "cli/command.hpp"
#include "cli/program.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline cli {
namespace {

/// Where standard input, output or error is closed, the next file to be opened would take its
/// number, and be read or written in its place.
void fillStandardDescriptors() {
  for (const int descriptor : {0, 1, 2})
    if (::fcntl(descriptor, F_GETFD) < 0)
      static_cast<void>(::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY));
}

/// What is still in the buffer may not find a place. A reader that has seen enough (`| head`) ends
/// the program without a word, by SIGPIPE.
void flushOutput() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw std::system_error(errno, std::generic_category(), "standard output");
}

/// Every way to end, as one line on standard error and the status that goes with it.
int runAndExplain(int argc, char** argv) {
  const auto explain = [](const std::exception& error, int status) {
    fmt::print(stderr, "crossgrain: {}\n", BadInput(error.what()).what());  // in one line
    return status;
  };
  try {
    const int status = runProgram(argc, argv);
    flushOutput();
    return status;
  } catch (const Interrupted& error) {
    return explain(error, exitInterrupted);
  } catch (const BadInput& error) {
    return explain(error, exitBadInput);
  } catch (const UnsupportedScene& error) {
    return explain(error, exitBadInput);
  } catch (const EngineFailure& error) {
    return explain(error, exitEngineFailed);
  } catch (const OutputError& error) {
    // A folder that cannot be written is the user's to change; that the disk is full is not.
    return explain(error, error.noRoom ? exitEngineFailed : exitBadInput);
  } catch (const std::exception& error) {
    return explain(error, exitBadInput);
  }
}

}  // namespace
}  // namespace crossgrain::inline cli

int main(int argc, char** argv) {
  gsl_set_error_handler_off();  // GSL's own would abort; its status codes are looked at
  crossgrain::fillStandardDescriptors();
  crossgrain::catchInterrupts();
  return crossgrain::runAndExplain(argc, argv);
}
