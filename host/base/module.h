// Libraries that most calls do not need live in modules of their own, loaded when they are.
#pragma once

#include <dlfcn.h>

#include <string_view>

namespace glint {

// Loads glint-NAME.so from beside the program, from lib/glint/modules of the prefix where that is
// installed, or from the build folder. It stays loaded. `what` names its library in the message:
// throws std::runtime_error with a whole sentence.
void* open_module(const char* name, std::string_view what);

// A C function of it.
template <class Function>
Function* find_function(void* module, const char* name) {
    return reinterpret_cast<Function*>(::dlsym(module, name));
}

}  // namespace glint
