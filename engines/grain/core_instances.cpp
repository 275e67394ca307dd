#include "engines/grain/core.hpp"

namespace grain {

template class Core<double>;
template class Core<float>;

}  // namespace grain
