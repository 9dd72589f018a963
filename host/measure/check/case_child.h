// The process that runs the cases of one file, one after the other as it is told.
#pragma once

#include "measure/check/process.h"

#include <sys/types.h>

namespace glint {

// All of a forked process. It tells the socket, a line of JSON each: that it is "compiling" or
// "alive", its "renderer" and all its "cases" (name, tweaks, group), and the "result" of each case
// whose number it reads there. It ends with the other end of the socket, or with its parent.
// `wanted.effort.seconds` are those that are left.
[[noreturn]] void be_a_case_child(const FileCheck& wanted, int socket, pid_t parent);

}  // namespace glint
