// What a check found, as JUnit XML: for those who run it in a pipeline and read what all their
// tools write alike.
#pragma once

#include "measure/check/process.h"

#include <span>
#include <string>

namespace glint {

// A <testsuite> a file, a <testcase> a case: <failure> with the note, and with the command that
// shows it again and its picture; <skipped> for what was left out. A file that could not be checked
// is an <error>.
std::string junit_xml(std::span<const CheckedFile> files);

}  // namespace glint
