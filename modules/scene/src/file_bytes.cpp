#include "detail/file_bytes.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace gnomon::scene::detail {

namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::int8_t, 256> make_base64_values() {
    std::array<std::int8_t, 256> values{};
    for (std::int8_t& v : values) v = -1;
    for (std::size_t i = 0; i < base64_digits.size(); ++i)
        values[static_cast<unsigned char>(base64_digits[i])] = static_cast<std::int8_t>(i);
    return values;
}
constexpr std::array<std::int8_t, 256> base64_values = make_base64_values();

std::optional<Bytes> decode_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (char c : text) {
        std::int8_t const value = base64_values[static_cast<unsigned char>(c)];
        if (value < 0) return std::nullopt;
        bits = (bits << 6U) | static_cast<std::uint32_t>(value);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<std::byte>((bits >> static_cast<unsigned>(held)) & 0xFFU));
    }
    return bytes;
}

int hex_value(char c) noexcept {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// `%20` to a space; anything after a % that is not two hex digits stays as it is.
std::string percent_decoded(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        int const high = uri[i] == '%' && i + 2 < uri.size() ? hex_value(uri[i + 1]) : -1;
        int const low = high >= 0 ? hex_value(uri[i + 2]) : -1;
        if (low < 0) {
            out += uri[i];
            continue;
        }
        out += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return out;
}

bool is_plain_relative(std::string_view path) noexcept {
    if (path.empty() || path.size() > 4096 || path.front() == '/') return false;
    for (char c : path)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F || c == '\\' || c == ':') return false;
    while (true) {
        std::size_t const slash = path.find('/');
        if (path.substr(0, slash) == "..") return false;
        if (slash == std::string_view::npos) return true;
        path.remove_prefix(slash + 1);
    }
}

}  // namespace

core::Result<Bytes, ReadError> read_file(std::string const& path, std::uint64_t max_bytes) {
    std::error_code error;
    std::filesystem::file_status const status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        if (status.type() == std::filesystem::file_type::not_found)
            return core::Failure{ReadError::not_found, "does not exist; check the path"};
        return core::Failure{ReadError::unreadable, "cannot be looked at (" + error.message() + "); check its permissions"};
    }
    if (!std::filesystem::is_regular_file(status))
        return core::Failure{ReadError::not_a_file, "is not a regular file; give a .gltf or .glb file"};
    std::uint64_t const size = std::filesystem::file_size(path, error);
    if (error) return core::Failure{ReadError::unreadable, "has no size (" + error.message() + "); check the disk"};
    if (size > max_bytes)
        return core::Failure{ReadError::too_large, "is " + std::to_string(size) + " bytes and " +
                                                       std::to_string(max_bytes) +
                                                       " are left of the limit; simplify it or raise max_file_bytes"};
    std::ifstream file(path, std::ios::binary);
    Bytes bytes(static_cast<std::size_t>(size));
    if (file) file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!file) return core::Failure{ReadError::unreadable, "cannot be read; check its permissions"};
    return bytes;
}

bool is_data_uri(std::string_view uri) noexcept { return uri.starts_with("data:"); }

std::optional<Bytes> decode_data_uri(std::string_view uri) {
    std::size_t const comma = uri.find(',');
    if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
    if (!uri.substr(0, comma).ends_with(";base64")) return std::nullopt;
    return decode_base64(uri.substr(comma + 1));
}

std::optional<std::string> resolve_uri(std::string_view uri, std::string const& base_dir) {
    std::string const path = percent_decoded(uri);
    if (base_dir.empty() || !is_plain_relative(path)) return std::nullopt;
    return base_dir + "/" + path;
}

std::string encode_base64(std::byte const* data, std::size_t size) {
    std::string text;
    text.reserve((size + 2) / 3 * 4);
    for (std::size_t i = 0; i < size; i += 3) {
        std::size_t const n = std::min<std::size_t>(3, size - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = (bits << 8U) | (k < n ? std::to_integer<std::uint32_t>(data[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= n ? base64_digits[(bits >> (18U - 6U * static_cast<unsigned>(k))) & 63U] : '=';
    }
    return text;
}

}  // namespace gnomon::scene::detail
