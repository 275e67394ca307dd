#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace crossgrain::test {

/// An answer as it might come: the line, and the content of the array file beside it.
struct Message {
  std::string request;  ///< that it answers
  std::string line;
  std::string file;
};

/// True answers of the toy engine, one to each request.
std::vector<Message> trueAnswers();

/// The k-th hostile message: a true answer with one to six things wrong. It depends on k alone.
Message hostileMessage(const std::vector<Message>& answers, std::uint64_t k);

}  // namespace crossgrain::test
