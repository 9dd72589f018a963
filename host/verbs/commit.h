// Which text this program was built of, as git tells it.
#pragma once

namespace glint {

extern const char* const kCommit;      // "68745b0c1234", "-dirty" behind it; "unknown" without git
extern const char* const kCommitDate;  // "2026-11-22"

}  // namespace glint
