#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline studies {

/// The conventions in which engines would differ from the defaults that the case leaves, and which
/// all of them can share: those that the case neither gives nor lists in `may_differ`, of which an
/// engine lacks the default, and of which all have one value, the first of the first engine's.
/// Engines without the case's normal law have no say: they refuse it or convert it. A value of
/// which an engine would lack something else, a lever arm that makes `plane_arm` matter, is not
/// taken: who can run the case as it is can run it with what is shared.
/// @returns overrides, "law.tension=\"cut\"", in the order of lawOptions(); none where nothing has
/// to be changed, or where engines share no value, which they then refuse in their own words
std::vector<std::string> sharedConventions(const Case& setup, const std::vector<Capabilities>& all);

/// The same of engines by the names that a user gave, two or more, which are started to be asked
/// where the case leaves a convention open. One that does not start and runs that are files have no
/// say; of "all" engines nothing is shared.
std::vector<std::string> sharedConventionsOf(const Case& setup,
                                             const std::vector<std::string>& engines);

/// "conventions that all engines named share: law.tension="cut", …", one line for people.
/// @pre there are some
std::string describeShared(const std::vector<std::string>& shared);

/// Puts what engines share behind the overrides of a command, and says so in a line.
/// @returns whether there was any, so that the case has to be loaded with it
bool shareConventions(const Case& setup, const std::vector<std::string>& engines,
                      std::vector<std::string>& overrides);

}  // namespace crossgrain::inline studies
