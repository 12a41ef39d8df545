#include <gnomon/scene.hpp>

#include <cstdio>

int main() {
    auto const made = gnomon::scene::make_procedural({.name = "cubes"});
    auto const unknown = gnomon::scene::make_procedural({.name = "no such scene"});
    if (unknown) return 1;
    std::puts(unknown.failure().message.c_str());
    return made ? 0 : 1;
}
