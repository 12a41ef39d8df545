#pragma once
// JSON out: just enough for a glTF file, with numbers that read back to the last bit.

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::scene::detail {

class JsonWriter {
public:
    std::string text;

    JsonWriter& begin_object() { return open('{'); }
    JsonWriter& end_object() { return close('}'); }
    JsonWriter& begin_array() { return open('['); }
    JsonWriter& end_array() { return close(']'); }

    JsonWriter& key(std::string_view name) {
        separate();
        append_string(name);
        text += ':';
        fresh_ = true;
        return *this;
    }

    JsonWriter& value(std::string_view string) {
        separate();
        append_string(string);
        return *this;
    }
    JsonWriter& value(char const* string) { return value(std::string_view(string)); }
    JsonWriter& value(bool flag) {
        separate();
        text += flag ? "true" : "false";
        return *this;
    }
    JsonWriter& value(std::uint64_t number) {
        separate();
        text += std::to_string(number);
        return *this;
    }
    /// A whole one gets a point, so that no reader takes it for an integer and wraps it.
    ///
    /// expects: finite.
    JsonWriter& value(double number) {
        separate();
        std::array<char, 32> buffer{};
        auto const* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
        std::string_view const digits(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
        text += digits;
        if (digits.find_first_of(".e") == std::string_view::npos) text += ".0";
        return *this;
    }

    template <class T>
    JsonWriter& member(std::string_view name, T const& v) {
        key(name);
        return value(v);
    }

private:
    JsonWriter& open(char bracket) {
        separate();
        text += bracket;
        fresh_ = true;
        return *this;
    }
    JsonWriter& close(char bracket) {
        text += bracket;
        fresh_ = false;
        return *this;
    }
    void separate() {
        if (!fresh_) text += ',';
        fresh_ = false;
    }
    void append_string(std::string_view string) {
        constexpr std::string_view hex = "0123456789abcdef";
        text += '"';
        for (char c : string) {
            auto const code = static_cast<unsigned char>(c);
            if (c == '"' || c == '\\') {
                text += '\\';
                text += c;
            } else if (code < 0x20) {
                text += "\\u00";
                text += hex[code >> 4U];
                text += hex[code & 15U];
            } else {
                text += c;
            }
        }
        text += '"';
    }

    bool fresh_ = true;
};

}  // namespace gnomon::scene::detail
