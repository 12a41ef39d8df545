#include "output.hpp"

#include "json.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace gnomon::command {

namespace fs = std::filesystem;

namespace {

/// The path without a trailing slash, links followed, so that renaming acts on the thing itself.
fs::path place(std::string const& path) {
    std::error_code error;
    fs::path const whole = fs::weakly_canonical(fs::absolute(path), error);
    fs::path const usable = error ? fs::absolute(path).lexically_normal() : whole;
    return usable.has_filename() ? usable : usable.parent_path();
}

fs::path temporary_beside(fs::path const& path, char const* what) {
    return path.parent_path() / fmt::format(".{}.{}-{}", path.filename().string(), what, getpid());
}

core::Failure<Exit> cannot_write(std::string const& path, std::string const& why) {
    return failure(fmt::format("{}: cannot be written ({}); give another place", path, why));
}

/// The first entry that an earlier gnomon did not write; empty if there is none.
std::string foreign_entry(fs::path const& folder) {
    std::error_code error;
    std::vector<std::string> entries;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        entries.push_back(it->path().filename().string());
    if (error) return ".";
    if (entries.empty()) return {};
    std::ifstream in(folder / "results.json", std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    std::vector<std::string> const ours = files_listed_in(text.str());
    for (std::string const& entry : entries) {
        bool const listed = std::find(ours.begin(), ours.end(), entry) != ours.end();
        if (!listed || !fs::is_regular_file(fs::symlink_status(folder / entry, error))) return entry;
    }
    return {};
}

/// Success, or the system's reason.
bool write_bytes(fs::path const& path, Bytes const& bytes, std::string& why) {
    errno = 0;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    for (std::size_t at = 0; out && at < bytes.size();) {
        std::size_t const part = std::min<std::size_t>(bytes.size() - at, std::size_t{1} << 20);
        std::string const chunk(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                bytes.begin() + static_cast<std::ptrdiff_t>(at + part));
        out.write(chunk.data(), static_cast<std::streamsize>(part));
        at += part;
    }
    out.close();
    if (out) return true;
    why = errno != 0 ? std::error_code(errno, std::generic_category()).message() : "the write failed";
    return false;
}

Outcome<core::Done> check_parent(std::string const& option, std::string const& path, fs::path const& target) {
    std::error_code error;
    fs::path const parent = target.parent_path();
    if (!fs::exists(parent, error))
        return failure(
            fmt::format("{} {}: the folder {} does not exist; make it first", option, path, parent.string()));
    if (!fs::is_directory(parent, error))
        return failure(fmt::format("{} {}: {} is not a folder; give another place", option, path, parent.string()));
    return core::Done{};
}

}  // namespace

Bytes bytes_of(std::string const& text) { return Bytes(text.begin(), text.end()); }

Outcome<core::Done> check_folder(std::string const& option, std::string const& path) {
    fs::path const target = place(path);
    if (auto parent = check_parent(option, path, target); !parent) return parent;
    std::error_code error;
    if (fs::exists(target, error)) {
        if (!fs::is_directory(target, error))
            return failure(fmt::format("{} {}: this is a file; give the name of a folder", option, path));
        if (fs::equivalent(target, fs::current_path(), error))
            return failure(
                fmt::format("{} {}: this is the folder you stand in; give the name of a new one", option, path));
        std::string const foreign = foreign_entry(target);
        if (!foreign.empty())
            return failure(
                fmt::format("{} {}: the folder holds '{}', which gnomon did not write; give another folder or empty "
                            "this one",
                            option, path, foreign));
    }
    fs::path const probe = temporary_beside(target, "probe");
    bool const made = fs::create_directory(probe, error);
    std::string const why = error.message();
    std::error_code ignored;
    fs::remove(probe, ignored);
    if (!made) return cannot_write(fmt::format("{} {}", option, path), why);
    return core::Done{};
}

Outcome<core::Done> check_file(std::string const& option, std::string const& path) {
    fs::path const target = place(path);
    if (auto parent = check_parent(option, path, target); !parent) return parent;
    std::error_code error;
    if (fs::is_directory(target, error))
        return failure(fmt::format("{} {}: this is a folder; give the name of a file", option, path));
    if (fs::exists(target, error) && !fs::is_regular_file(target, error)) return core::Done{};
    fs::path const probe = temporary_beside(target, "probe");
    std::string why;
    bool const made = write_bytes(probe, {}, why);
    fs::remove(probe, error);
    if (!made) return cannot_write(fmt::format("{} {}", option, path), why);
    return core::Done{};
}

Outcome<FolderWriter> FolderWriter::begin(std::string const& path) {
    std::error_code error;
    fs::create_directory(temporary_beside(place(path), "new"), error);
    if (error) return cannot_write(path, error.message());
    return FolderWriter(path);
}

FolderWriter::FolderWriter(FolderWriter&& other) noexcept
    : path_(std::exchange(other.path_, {})), names_(std::move(other.names_)) {}

FolderWriter::~FolderWriter() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(temporary_beside(place(path_), "new"), ignored);
}

Outcome<core::Done> FolderWriter::add(std::string const& name, Bytes const& bytes) {
    std::string why;
    if (!write_bytes(temporary_beside(place(path_), "new") / name, bytes, why))
        return cannot_write(path_ + '/' + name, why);
    names_.push_back(name);
    return core::Done{};
}

Outcome<core::Done> FolderWriter::commit() {
    fs::path const target = place(path_);
    fs::path const fresh = temporary_beside(target, "new");
    fs::path const old = temporary_beside(target, "old");
    std::error_code error;
    std::error_code ignored;
    bool const replaces = fs::exists(target, ignored);
    if (replaces) fs::rename(target, old, error);
    if (!error) {
        fs::rename(fresh, target, error);
        if (error && replaces) fs::rename(old, target, ignored);
    }
    if (error) return cannot_write(path_, error.message());
    fs::remove_all(old, ignored);
    path_.clear();
    return core::Done{};
}

Outcome<core::Done> write_folder(std::string const& path, std::vector<OutputFile> const& files) {
    auto folder = FolderWriter::begin(path);
    if (!folder) return std::move(folder).failure();
    for (OutputFile const& file : files)
        if (auto added = folder->add(file.name, file.bytes); !added) return added;
    return folder->commit();
}

Outcome<core::Done> write_file(std::string const& path, Bytes const& bytes) {
    fs::path const target = place(path);
    std::error_code error;
    std::string why;
    bool const direct = fs::exists(target, error) && !fs::is_regular_file(target, error);
    fs::path const fresh = direct ? target : temporary_beside(target, "new");
    bool const written = write_bytes(fresh, bytes, why);
    if (written && !direct) {
        fs::rename(fresh, target, error);
        if (error) why = error.message();
    }
    if (written && (direct || !error)) return core::Done{};
    if (!direct) fs::remove(fresh, error);
    return cannot_write(path, why);
}

}  // namespace gnomon::command
