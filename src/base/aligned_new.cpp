// Replaces operator new in the programs: long blocks start at a cache line. A vector of 64 bytes that straddles two lines takes two
// accesses, and the allocator of the C library never places long blocks at a line: the loops over points take up to a third longer.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

void* operator new(std::size_t size) {
  constexpr std::size_t line = 64, long_block = 512, max = PTRDIFF_MAX - line;
  if (size > max) throw std::bad_alloc();
  while (true) {
    void* block = size < long_block ? std::malloc(size == 0 ? 1 : size) : std::aligned_alloc(line, (size + line - 1) / line * line);
    if (block != nullptr) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
