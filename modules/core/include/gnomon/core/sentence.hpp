#pragma once
// Sentences of failures.

#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>

namespace gnomon::core {

/// Nine digits, of small and large numbers too: "1e-12", "0.1".
[[nodiscard]] inline std::string text_of(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", x);
    return text;
}

/// One sentence of its parts. (A sum of strings is what GCC 12 warns of without reason.)
[[nodiscard]] inline std::string sentence(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (std::string_view const part : parts) text.append(part);
    return text;
}

}  // namespace gnomon::core
