#pragma once
// Bytes from outside: files, data URIs, and the rule which files a scene may name.

#include <gnomon/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene::detail {

using Bytes = std::vector<std::byte>;

enum class ReadError : std::uint8_t {
    not_found,
    not_a_file,  ///< A folder, a device, a pipe: reading one could hang.
    unreadable,
    too_large,
};

/// The whole of a regular file of at most `max_bytes`.
///
/// returns: on failure a phrase that follows the file's name, as "does not exist".
core::Result<Bytes, ReadError> read_file(std::string const& path, std::uint64_t max_bytes);

/// The bytes of `data:[type][;parameters];base64,...`, or nothing where it is not one or not clean base64.
std::optional<Bytes> decode_data_uri(std::string_view uri);

bool is_data_uri(std::string_view uri) noexcept;

/// The file that `uri` names, inside `base_dir` or below it.
///
/// returns: on failure nothing: absolute paths, schemes, `..`, backslashes and control characters, whether plain or
///          percent-encoded, and an empty `base_dir`.
std::optional<std::string> resolve_uri(std::string_view uri, std::string const& base_dir);

std::string encode_base64(std::byte const* data, std::size_t size);

}  // namespace gnomon::scene::detail
