// Shows: shadows of a scene drawn by the library's techniques, measured against exact truth, and timed.

#include "options.hpp"
#include "verbs.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <variant>

namespace {

using namespace gnomon::command;

/// The command as one could type it again: arguments with unusual characters in quotes.
std::string as_typed(int argc, char const* const* argv) {
    std::string text = "gnomon";
    for (int i = 1; i < argc; ++i) {
        std::string const word = argv[i];
        bool const plain = !word.empty() && word.find_first_not_of(
                                                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                "0123456789-_=+.,:/@%") == std::string::npos;
        std::string quoted = "'";
        for (char const c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        text += ' ' + (plain ? word : quoted + "'");
    }
    return text;
}

struct Dispatch {
    std::string command;
    Outcome<gnomon::core::Done> operator()(HelpText const& help) const { return print(help.text); }
    Outcome<gnomon::core::Done> operator()(RunOptions options) const {
        options.command = command;
        bool const flies = options.verb == Verb::flythrough || options.motion.path;
        return flies ? fly(options) : run(options);
    }
    Outcome<gnomon::core::Done> operator()(BenchOptions options) const {
        options.run.command = command;
        return options.which == Bench::lights ? bench_lights(options) : bench_cascades(options);
    }
    Outcome<gnomon::core::Done> operator()(ScenesOptions const& options) const { return list_or_write_scenes(options); }
    Outcome<gnomon::core::Done> operator()(InfoOptions const& options) const {
        return options.devices ? show_devices() : show_info();
    }
};

int fail(Exit code, std::string const& sentence) {
    std::fprintf(stderr, "gnomon: %s\n", sentence.c_str());
    return static_cast<int>(code);
}

int run_command(int argc, char const* const* argv) {
    auto command = parse_command_line(argc, argv);
    if (!command) return fail(command.failure().code, command.failure().message);
    auto done = std::visit(Dispatch{as_typed(argc, argv)}, *std::move(command));
    if (!done) return fail(done.failure().code, done.failure().message);
    return static_cast<int>(Exit::done);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run_command(argc, argv);
    } catch (std::bad_alloc const&) {
        return fail(Exit::failed, "memory ran out; give a smaller --size, scene or resolution");
    } catch (std::exception const& error) {
        return fail(Exit::failed, std::string(error.what()) + "; this is a bug worth reporting with the command line");
    }
}
