#pragma once
// A glTF file taken apart: tinygltf's model, and the bytes that it speaks of, which tinygltf never gets to see.

#include "failure.hpp"
#include "file_bytes.hpp"

#include <gnomon/scene/load.hpp>

#include <tiny_gltf.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace gnomon::scene::detail {

/// What stands for an element of `images`; any of it may be missing or wrong.
struct ImageSource {
    std::string name;
    std::string uri;
    std::uint64_t view = none;
};

class Document {
public:
    /// `file` must outlive the document.
    Document(std::span<std::byte const> file, std::string base_dir, LoadConfig const& config);

    /// The bytes of a buffer view, wholly inside its buffer; fails with the names of both where they are not.
    [[nodiscard]] std::span<std::byte const> view_bytes(std::uint64_t view) const;

    /// The bytes of an external file or a data URI.
    ///
    /// returns: on failure a phrase that follows the URI, as "does not exist".
    core::Result<Bytes, SceneError> uri_bytes(std::string const& uri);

    void warn(std::string sentence);

    /// Counts vertices and other elements that are about to be decoded against the limit.
    void charge_elements(std::uint64_t count);

    /// Counts numbers of clips, skins and morph weights that are about to be decoded against the limit.
    void charge_motion(std::uint64_t count);

    tinygltf::Model model;
    std::vector<ImageSource> images;
    Notes notes;
    std::uint64_t triangles = 0;  ///< Read so far, each mesh once.
    LoadConfig const& config;

private:
    struct Buffer {
        Bytes owned;
        std::span<std::byte const> bytes;
    };

    void split_glb(std::span<std::byte const> file);
    void parse(std::string_view json);
    void check_extensions();
    void load_buffers(tinygltf::Value const& list);
    void list_images(tinygltf::Value const& list);
    Buffer load_buffer(tinygltf::Value const& value, std::uint64_t index);

    std::string base_dir_;
    std::string_view json_;
    std::span<std::byte const> glb_bytes_;
    bool has_glb_bytes_ = false;
    std::vector<Buffer> buffers_;
    std::uint64_t bytes_left_;
    std::uint64_t elements_ = 0;
    std::uint64_t motion_ = 0;
};

/// A member of an extension or of extras; null where it is not there.
inline tinygltf::Value const* member(tinygltf::Value const& value, char const* key) {
    return value.IsObject() && value.Has(key) ? &value.Get(std::string(key)) : nullptr;
}

inline tinygltf::Value const* extension(tinygltf::ExtensionMap const& map, char const* name) {
    auto const found = map.find(name);
    return found == map.end() ? nullptr : &found->second;
}

/// A whole number from 0 to 2^31 - 1, or `none`.
inline std::uint32_t whole_or_none(tinygltf::Value const* value) {
    if (value == nullptr || !value->IsInt() || value->GetNumberAsInt() < 0) return none;
    return static_cast<std::uint32_t>(value->GetNumberAsInt());
}

}  // namespace gnomon::scene::detail
