#define GNOMON_CONTRACTS 1
#include <gnomon/check/check.hpp>
#include <gnomon/core/contract.hpp>

#include <string>

namespace {

// A handler is a plain function, so what it saw must be static.
std::string& seen() {
    static std::string text;
    return text;
}

void remember(gnomon::core::ContractViolation const& violation) { seen() = violation.condition; }

}  // namespace

TEST_CASE("a broken contract reaches the installed handler with its condition", "[core][contract]") {
    auto const previous = gnomon::core::set_contract_handler(&remember);
    int const answer = 41;
    seen().clear();
    GNOMON_EXPECT(answer == 41);
    CHECK(seen().empty());
    GNOMON_EXPECT(answer == 42);
    CHECK(seen() == "answer == 42");
    CHECK(gnomon::core::set_contract_handler(previous) == &remember);
}

TEST_CASE("a null contract handler restores the default", "[core][contract]") {
    auto const original = gnomon::core::set_contract_handler(&remember);
    CHECK(gnomon::core::set_contract_handler(nullptr) == &remember);
    CHECK(gnomon::core::set_contract_handler(original) != nullptr);
}
