#pragma once
// Sentences of failures.

#include <gnomon/math/vec.hpp>

#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>

namespace gnomon::cascade::detail {

inline std::string text_of(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", x);
    return text;
}

/// One sentence of its parts. (A sum of strings is what GCC 12 warns of without reason.)
inline std::string sentence(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (std::string_view const part : parts) text.append(part);
    return text;
}

inline std::string text_of(math::dvec3 const& v) {
    return sentence({"(", text_of(v.x), ", ", text_of(v.y), ", ", text_of(v.z), ")"});
}

}  // namespace gnomon::cascade::detail
