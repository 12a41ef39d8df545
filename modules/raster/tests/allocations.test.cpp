#include "allocations.hpp"

#include <gnomon/check/check.hpp>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace {

std::atomic<std::uint64_t> count{0};

void* counted(void* p) {
    ++count;
    if (p == nullptr) throw std::bad_alloc();
    return p;
}

}  // namespace

std::uint64_t allocations_made() noexcept { return count; }

[[gnu::noinline]] void* operator new(std::size_t size) { return counted(std::malloc(size == 0 ? 1 : size)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    auto const step = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

TEST_CASE("allocations are counted, aligned or not", "[raster][memory]") {
    std::uint64_t const before = allocations_made();
    std::vector<int> const plain(3);
    CHECK(allocations_made() == before + 1);
    struct alignas(64) Line {
        char bytes[64];
    };
    auto const aligned = std::make_unique<Line>();
    CHECK(allocations_made() == before + 2);
}
