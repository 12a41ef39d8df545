#pragma once
// Contracts: what a caller must guarantee. A broken contract is a bug of the caller, never of the data.
//
// `GNOMON_EXPECT(cond)` calls the process's contract handler when `cond` is false. It is checked unless NDEBUG is
// defined; GNOMON_CONTRACTS=0 or =1 before the first include decides explicitly. The handler is the only
// process-wide state of the library: an engine installs its own once, a test installs one that records.

#include <atomic>
#include <cstdio>
#include <cstdlib>

#ifndef GNOMON_CONTRACTS
#ifdef NDEBUG
#define GNOMON_CONTRACTS 0
#else
#define GNOMON_CONTRACTS 1
#endif
#endif

namespace gnomon::core {

/// A broken contract: the condition as written and where it stands.
struct ContractViolation {
    char const* condition;
    char const* file;
    int line;
};

/// Called for each broken contract. If it returns, the function goes on with whatever the bug gives.
using ContractHandler = void (*)(ContractViolation const&);

namespace detail {

[[noreturn]] inline void report_and_abort(ContractViolation const& violation) {
    std::fprintf(stderr, "%s:%d: contract broken: %s\n", violation.file, violation.line, violation.condition);
    std::abort();
}

inline std::atomic<ContractHandler> contract_handler{&report_and_abort};

inline void contract_broken(char const* condition, char const* file, int line) {
    contract_handler.load(std::memory_order_relaxed)(ContractViolation{condition, file, line});
}

}  // namespace detail

/// Installs `handler` for the whole process; null restores the default, which prints and aborts.
///
/// returns: the handler that was installed before.
inline ContractHandler set_contract_handler(ContractHandler handler) noexcept {
    return detail::contract_handler.exchange(handler == nullptr ? &detail::report_and_abort : handler);
}

}  // namespace gnomon::core

#if GNOMON_CONTRACTS
#define GNOMON_EXPECT(...) \
    (static_cast<bool>(__VA_ARGS__) ? void() : ::gnomon::core::detail::contract_broken(#__VA_ARGS__, __FILE__, __LINE__))
#else
// Not evaluated, but still compiled, so that a contract cannot rot.
#define GNOMON_EXPECT(...) (static_cast<void>(sizeof(static_cast<bool>(__VA_ARGS__))))
#endif
