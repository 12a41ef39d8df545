#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>

GNOMON_COUNT_ALLOCATIONS;

TEST_CASE("allocations are counted, aligned or not, throwing or not", "[check][allocations]") {
    auto const line = std::align_val_t{64};
    std::uint64_t made[5];
    made[0] = gnomon::check::allocations_made();
    void* const plain = ::operator new(12);
    made[1] = gnomon::check::allocations_made();
    void* const aligned = ::operator new(65, line);
    made[2] = gnomon::check::allocations_made();
    void* const quiet = ::operator new(0, std::nothrow);
    made[3] = gnomon::check::allocations_made();
    void* const quiet_aligned = ::operator new(64, line, std::nothrow);
    made[4] = gnomon::check::allocations_made();
    CHECK(reinterpret_cast<std::uintptr_t>(aligned) % 64 == 0);
    ::operator delete(plain);
    ::operator delete(aligned, line);
    ::operator delete(quiet, std::nothrow);
    ::operator delete(quiet_aligned, line, std::nothrow);
    for (int i = 1; i < 5; ++i) CHECK(made[i] == made[0] + static_cast<std::uint64_t>(i));
}
