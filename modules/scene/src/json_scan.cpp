#include "detail/json_scan.hpp"

#include "detail/failure.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gnomon::scene::detail {

namespace {

/// Members whose values glTF defines as whole numbers that are not negative, or as arrays of such.
constexpr std::array<std::string_view, 27> whole_number_keys{
    "buffer",     "bufferView", "byteLength", "byteOffset", "byteStride", "camera", "children", "componentType",
    "count",      "index",      "indices",    "input",      "inverseBindMatrices",  "joints",   "material",
    "mesh",       "mode",       "node",       "nodes",      "output",     "sampler", "scene",   "skeleton",
    "skin",       "source",     "texCoord",   "attributes"};


bool is_whole_number(std::string_view token) noexcept {
    if (token.empty() || token.size() > 10) return false;
    std::uint64_t value = 0;
    for (char c : token) {
        if (c < '0' || c > '9') return false;
        value = value * 10 + static_cast<std::uint64_t>(c - '0');
    }
    return value <= 0x7FFF'FFFFU;
}

bool is_space(char c) noexcept { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Materials and the like weigh kilobytes when parsed, however short they are in the text.
constexpr std::uint64_t max_root_objects = 1U << 16U;
constexpr std::array<std::string_view, 7> heavy_arrays{"materials", "textures", "samplers", "scenes",
                                                       "cameras",   "images",   "buffers"};

/// Root members of which glTF defines what is in them; others may hold anything.
constexpr std::array<std::string_view, 14> known_members{"accessors", "animations", "asset",     "buffers", "bufferViews",
                                                         "cameras",   "images",     "materials", "meshes",  "nodes",
                                                         "samplers",  "scenes",     "skins",     "textures"};

/// Arrays of which glTF 1.0 makes objects.
constexpr std::array<std::string_view, 5> once_objects{"accessors", "bufferViews", "buffers", "meshes", "nodes"};

template <std::size_t N>
bool holds(std::array<std::string_view, N> const& words, std::string_view word) noexcept {
    return std::find(words.begin(), words.end(), word) != words.end();
}

class Scanner {
public:
    Scanner(std::string_view json, Limits const& limits) : json_(json), limits_(limits) {}

    ScannedJson run() {
        if (json_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        while (skip_spaces(), at_ < json_.size()) step();
        if (!frames_.empty() || root_end_ == 0)
            fail(SceneError::malformed, "the JSON ends after " + std::to_string(json_.size()) +
                                            " bytes before its brackets are closed; the file is cut off or not glTF");
        return compose();
    }

private:
    struct Frame {
        bool is_object = false;
        bool is_free = false;       ///< Inside `extras` or `extensions`: anything goes.
        bool expects_key = false;
        std::string_view key;       ///< The member being read; in an array, the member that the array is.
        std::string_view owner;     ///< The member that this container is.
        std::size_t value_begin = 0;
        std::uint64_t values = 0;
    };
    struct Cut {
        std::size_t begin;
        std::size_t end;
    };

    void skip_spaces() noexcept {
        while (at_ < json_.size() && is_space(json_[at_])) ++at_;
    }

    void step() {
        if (root_end_ != 0) bad("has more text after its closing bracket");
        switch (json_[at_]) {
            case '{':
            case '[': open(json_[at_] == '{'); break;
            case '}':
            case ']': close(json_[at_] == '}'); break;
            case ',':
                if (!frames_.empty()) frames_.back().expects_key = frames_.back().is_object;
                ++at_;
                break;
            case ':': ++at_; break;
            case '"': string(); break;
            default: scalar(); break;
        }
    }

    [[noreturn]] void bad(std::string const& what) const {
        fail(SceneError::malformed,
             "the JSON " + what + " at byte " + std::to_string(at_) + "; the file is damaged or not glTF");
    }

    void open(bool is_object) {
        begin_value();
        if (frames_.size() >= limits_.max_json_depth)
            fail(SceneError::over_limit, "the JSON nests deeper than " + std::to_string(limits_.max_json_depth) +
                                             " brackets at byte " + std::to_string(at_) +
                                             "; simplify it or raise max_json_depth");
        Frame frame;
        frame.is_object = is_object;
        frame.expects_key = is_object;
        if (!frames_.empty()) {
            Frame const& parent = frames_.back();
            frame.owner = parent.key;
            if (!is_object) frame.key = parent.key;
            frame.is_free = parent.is_free || parent.key == "extras" || parent.key == "extensions";
            if (frames_.size() == 1) check_root_member(parent.key, frame);
        }
        frames_.push_back(frame);
        ++at_;
    }

    void check_root_member(std::string_view key, Frame& frame) const {
        frame.is_free = frame.is_free || !holds(known_members, key);
        if (frame.is_object && holds(once_objects, key))
            fail(SceneError::not_gltf, quoted(key) + " is an object before byte " + std::to_string(at_) +
                                           " of the JSON, as in glTF 1.0; export the file as version 2.0");
    }

    void close(bool is_object) {
        if (frames_.empty() || frames_.back().is_object != is_object) bad("closes a bracket that is not open");
        frames_.pop_back();
        ++at_;
        if (frames_.empty()) {
            root_end_ = at_ - 1;
            if (!is_object) bad("is not an object");
        } else {
            end_value();
        }
    }

    void string() {
        std::size_t const begin = at_;
        for (++at_; at_ < json_.size() && json_[at_] != '"'; ++at_)
            if (json_[at_] == '\\') ++at_;
        if (at_ >= json_.size()) {
            at_ = begin;
            bad("has a string without an end");
        }
        ++at_;
        std::string_view const text = json_.substr(begin + 1, at_ - begin - 2);
        if (frames_.empty()) bad("is not an object");
        if (frames_.back().expects_key) {
            frames_.back().expects_key = false;
            frames_.back().key = text;
            return;
        }
        at_ = begin;
        begin_value();
        at_ = begin + text.size() + 2;
        check_number("\"" + std::string(text.substr(0, 40)) + "\"");
        end_value();
    }

    void scalar() {
        if (frames_.empty()) bad("is not an object");
        begin_value();
        std::size_t const begin = at_;
        while (at_ < json_.size() && !is_space(json_[at_]) && std::string_view(",:{}[]\"").find(json_[at_]) == std::string_view::npos)
            ++at_;
        check_number(std::string(json_.substr(begin, std::min<std::size_t>(at_ - begin, 40))));
        end_value();
    }

    void check_number(std::string const& token) const {
        Frame const& frame = frames_.back();
        if (frame.is_free || is_whole_number(token)) return;
        bool const is_attribute = frame.is_object && (frame.owner == "attributes" || frame.owner == "targets");
        if (!is_attribute && !holds(whole_number_keys, frame.key)) return;
        fail(SceneError::malformed, quoted(frame.key) + " is " + token + " before byte " + std::to_string(at_) +
                                        " of the JSON; glTF wants a whole number from 0 to 2147483647 there");
    }

    void begin_value() {
        if (++values_ > limits_.max_json_values)
            fail(SceneError::over_limit, "the JSON holds more than " + std::to_string(limits_.max_json_values) +
                                             " values; simplify it or raise max_json_values");
        if (frames_.empty()) return;
        Frame& frame = frames_.back();
        frame.value_begin = at_;
        ++frame.values;
        if (frames_.size() == 2 && !frame.is_object) check_root_array(frame);
    }

    void check_root_array(Frame const& frame) const {
        bool const heavy = std::find(heavy_arrays.begin(), heavy_arrays.end(), frame.owner) != heavy_arrays.end();
        std::uint64_t const most = heavy ? max_root_objects : limits_.max_nodes;
        if (frame.values > most)
            fail(SceneError::over_limit, "the file has more than " + std::to_string(most) + " " +
                                             std::string(frame.owner) + "; simplify it or raise max_nodes");
    }

    void end_value() {
        Frame const& frame = frames_.back();
        if (frames_.size() == 1 && (frame.key == "buffers" || frame.key == "images" || frame.key == "extras"))
            cuts_.push_back({frame.value_begin, at_});
        if (frames_.size() != 2 || frame.is_object) return;
        if (frame.owner == "buffers") out_.buffers.push_back(json_.substr(frame.value_begin, at_ - frame.value_begin));
        if (frame.owner == "images") out_.images.push_back(json_.substr(frame.value_begin, at_ - frame.value_begin));
    }

    /// The original with each cut replaced by 0, and the cut elements as root extras, each inside an array of its own:
    /// the parser drops empty objects from extras, which would shift those after them.
    ScannedJson compose() {
        std::size_t from = 0;
        for (Cut const& cut : cuts_) {
            out_.text += json_.substr(from, cut.begin - from);
            out_.text += '0';
            from = cut.end;
        }
        out_.text += json_.substr(from, root_end_ - from);
        if (!out_.buffers.empty() || !out_.images.empty()) {
            out_.text += R"(,"extras":{"buffers":[[0])";
            for (std::string_view element : out_.buffers) out_.text.append(",[0,").append(element).append("]");
            out_.text += R"(],"images":[[0])";
            for (std::string_view element : out_.images) out_.text.append(",[0,").append(element).append("]");
            out_.text += "]}";
        }
        out_.text += '}';
        return std::move(out_);
    }

    std::string_view json_;
    Limits const& limits_;
    std::size_t at_ = 0;
    std::size_t root_end_ = 0;
    std::uint64_t values_ = 0;
    std::vector<Frame> frames_;
    std::vector<Cut> cuts_;
    ScannedJson out_;
};

}  // namespace

ScannedJson scan_json(std::string_view json, Limits const& limits) { return Scanner(json, limits).run(); }

}  // namespace gnomon::scene::detail
