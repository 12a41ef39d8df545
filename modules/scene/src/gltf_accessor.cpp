#include "detail/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>

namespace gnomon::scene::detail {

namespace {

template <class T>
T load_as(std::byte const* at) noexcept {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

std::size_t component_bytes(int type) noexcept {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
        default: return 0;
    }
}

int component_count(int type) noexcept {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR: return 1;
        case TINYGLTF_TYPE_VEC2: return 2;
        case TINYGLTF_TYPE_VEC3: return 3;
        case TINYGLTF_TYPE_VEC4: return 4;
        case TINYGLTF_TYPE_MAT4: return 16;
        default: return 0;
    }
}

/// Whether `count` elements of `element` bytes, `stride` apart, from `offset`, end within `size`. Overflows nowhere.
bool fits(std::size_t size, std::size_t offset, std::size_t count, std::size_t stride, std::size_t element) noexcept {
    if (count == 0) return true;
    if (offset > size || element > size - offset) return false;
    return (count - 1) <= (size - offset - element) / stride;
}

[[noreturn]] void bad_accessor(int index, std::string const& what) {
    fail(SceneError::malformed, item("accessor", static_cast<std::uint64_t>(index)) + " " + what + "; export the file again");
}

void add_dense(Document& document, tinygltf::Accessor const& in, int index, Accessor& out) {
    auto const view = static_cast<std::uint64_t>(in.bufferView);
    std::span<std::byte const> const bytes = document.view_bytes(view);
    std::size_t const stride = document.model.bufferViews[view].byteStride;
    out.stride = stride == 0 ? out.element_bytes : stride;
    if (out.stride < out.element_bytes)
        bad_accessor(index, "has elements of " + std::to_string(out.element_bytes) + " bytes in a stride of " +
                                std::to_string(out.stride));
    if (!fits(bytes.size(), in.byteOffset, in.count, out.stride, out.element_bytes))
        bad_accessor(index, "has " + std::to_string(in.count) + " elements of " + std::to_string(out.element_bytes) +
                                " bytes, " + std::to_string(out.stride) + " apart, from byte " +
                                std::to_string(in.byteOffset) + " of a buffer view of " + std::to_string(bytes.size()));
    if (in.count != 0) out.data = bytes.data() + in.byteOffset;
}

/// A packed array inside a buffer view, as the two parts of a sparse accessor are.
struct SparsePart {
    int view;
    int offset;
    std::size_t count;
    std::size_t element_bytes;
};

std::byte const* sparse_bytes(Document const& document, SparsePart const& part, int index) {
    if (part.view < 0 || part.offset < 0) bad_accessor(index, "has a sparse part without a buffer view");
    std::span<std::byte const> const bytes = document.view_bytes(static_cast<std::uint64_t>(part.view));
    if (!fits(bytes.size(), static_cast<std::size_t>(part.offset), part.count, part.element_bytes, part.element_bytes))
        bad_accessor(index, "has " + std::to_string(part.count) + " sparse elements of " +
                                std::to_string(part.element_bytes) + " bytes from byte " + std::to_string(part.offset) +
                                " of a buffer view of " + std::to_string(bytes.size()));
    return bytes.data() + part.offset;
}

void add_sparse(Document& document, tinygltf::Accessor const& in, int index, Accessor& out) {
    auto const& sparse = in.sparse;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > in.count)
        bad_accessor(index, "has " + std::to_string(sparse.count) + " sparse elements of " + std::to_string(in.count));
    auto const count = static_cast<std::size_t>(sparse.count);
    int const type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        bad_accessor(index, "has sparse indices of type " + std::to_string(type));
    Accessor indices;
    indices.component_type = type;
    indices.stride = component_bytes(type);
    indices.count = count;
    indices.data = sparse_bytes(document, {sparse.indices.bufferView, sparse.indices.byteOffset, count, indices.stride}, index);
    out.sparse_values =
        sparse_bytes(document, {sparse.values.bufferView, sparse.values.byteOffset, count, out.element_bytes}, index);
    document.charge_elements(count);
    out.sparse_indices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t const at = indices.index_at(i);
        if (at >= in.count || (i != 0 && at <= out.sparse_indices.back()))
            bad_accessor(index, "has the sparse index " + std::to_string(at) + " out of order or out of its " +
                                    std::to_string(in.count) + " elements");
        out.sparse_indices.push_back(at);
    }
}

}  // namespace

std::byte const* Accessor::element(std::size_t i) const noexcept {
    if (!sparse_indices.empty()) {
        auto const found = std::lower_bound(sparse_indices.begin(), sparse_indices.end(), i);
        if (found != sparse_indices.end() && *found == i)
            return sparse_values + static_cast<std::size_t>(found - sparse_indices.begin()) * element_bytes;
    }
    return data == nullptr ? nullptr : data + i * stride;
}

float Accessor::at(std::size_t i, int c) const noexcept {
    std::byte const* at = element(i);
    if (at == nullptr) return 0.0F;
    at += static_cast<std::size_t>(c) * component_bytes(component_type);
    auto const scaled = [this](double value, double largest) {
        return static_cast<float>(normalized ? std::max(value / largest, -1.0) : value);
    };
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled(load_as<std::int8_t>(at), 127.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled(load_as<std::uint8_t>(at), 255.0);
        case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled(load_as<std::int16_t>(at), 32767.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scaled(load_as<std::uint16_t>(at), 65535.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return scaled(load_as<std::uint32_t>(at), 4294967295.0);
        default: return load_as<float>(at);
    }
}

std::uint32_t Accessor::whole_at(std::size_t i, int c) const noexcept {
    std::byte const* at = element(i);
    if (at == nullptr) return 0;
    at += static_cast<std::size_t>(c) * component_bytes(component_type);
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return load_as<std::uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return load_as<std::uint16_t>(at);
        default: return load_as<std::uint32_t>(at);
    }
}

Accessor make_accessor(Document& document, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.accessors.size())
        fail(SceneError::malformed, "accessor " + std::to_string(index) + " is named and there are only " +
                                        std::to_string(document.model.accessors.size()) + "; export the file again");
    tinygltf::Accessor const& in = document.model.accessors[static_cast<std::size_t>(index)];
    Accessor out;
    out.count = in.count;
    out.components = component_count(in.type);
    out.component_type = in.componentType;
    out.normalized = in.normalized;
    out.element_bytes = component_bytes(in.componentType) * static_cast<std::size_t>(out.components);
    if (component_bytes(in.componentType) == 0)
        bad_accessor(index, "has component type " + std::to_string(in.componentType) + ", which is none of glTF's");
    if (out.components == 0) bad_accessor(index, "holds matrices of a size that is not read here");
    if (in.bufferView >= 0)
        add_dense(document, in, index, out);
    else if (in.count > document.config.limits.max_zero_elements)
        fail(SceneError::over_limit, item("accessor", static_cast<std::uint64_t>(index)) + " has " +
                                         std::to_string(in.count) + " elements and no bytes, above the limit of " +
                                         std::to_string(document.config.limits.max_zero_elements) +
                                         "; give it a buffer view or raise max_zero_elements");
    if (in.sparse.isSparse) add_sparse(document, in, index, out);
    return out;
}

}  // namespace gnomon::scene::detail
