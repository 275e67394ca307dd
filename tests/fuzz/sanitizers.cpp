/// Options of the address and leak sanitizers for programs that read damaged input, where built
/// with them; README.md. Linked into each, so that one input alone is read as a million are.
#ifdef __SANITIZE_ADDRESS__

extern "C" {

/// HDF5 requests as much memory as a damaged file claims and can bear a refusal; our own code must
/// not request it: a larger operator new is an error.
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

/// HDF5 1.10.8 does not free its memory when it finds that a file is damaged.
const char* __lsan_default_suppressions() {
  return "leak:libhdf5_serial\n";
}
}

#endif
