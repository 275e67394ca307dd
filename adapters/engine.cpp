#include "adapters/engine.hpp"

namespace crossgrain {

void Engine::checkpoint(const std::filesystem::path&) {
  throw EngineFailure("this engine has no checkpoints");
}

void Engine::restore(const std::filesystem::path&) {
  throw EngineFailure("this engine has no checkpoints");
}

}  // namespace crossgrain
