#pragma once

#include <string>

namespace crossgrain::test {

/// What lyingWorker() can do.
bool liesAboutFiles(const std::string& mischief);

/// A worker that needs nothing of this project but its JSON. What it says of the file of a snapshot
/// is not so: "short" has less than it promises, "many" 10⁹ contacts in a hole, "pipe" and "device"
/// are no files. "cuts" does not lie: it makes each file anew. "forgets" and "replaces" say that
/// they write over what a file holds, and write nothing, or a file of their own.
int lyingWorker(const std::string& mischief);

/// To whoever reads descriptor 4.
void say(const std::string& text);

/// A line of lists in lists that would take a reader's stack.
std::string deepAnswer();

}  // namespace crossgrain::test
