/// What programs that read damaged input tell the address and leak sanitizers, where they are built
/// with them; README.md. Linked into each, so that one input alone is read as a million are.
#ifdef __SANITIZE_ADDRESS__

extern "C" {

/// HDF5 asks for as much as a damaged file claims and takes no for an answer; our own code is not
/// to ask at all: an operator new of more is an error.
const char* __asan_default_options() {
  return "allocator_may_return_null=1:max_allocation_size_mb=64:malloc_context_size=5";
}

/// HDF5 1.10.8 (Debian 12) reads past the end of its own buffers where a damaged file says that
/// more is there.
const char* __asan_default_suppressions() {
  return "interceptor_via_lib:libhdf5_serial\n";
}

const char* __lsan_default_options() {
  return "print_suppressions=0";
}

/// What HDF5 1.10.8 had allocated when it found a file damaged it does not give back.
const char* __lsan_default_suppressions() {
  return "leak:libhdf5_serial\n";
}
}

#endif
