// What an unstable step does that a limit holds: it goes to and fro between two states for ever,
// however large these are.
#pragma once

#include "measure/check/subject.h"

#include <vector>

namespace glint {

constexpr int kTurns = 32;  // frames that goes_to_and_fro() plays

// Of two states, by all their values; of what the second lacks, from 0.
double distance(const std::vector<float>& a, const std::vector<float>& b);

// Plays on from this frame, at this rate: whether from frame to frame what is fed back goes back
// nearly to where it was, and that is no small part of it. What swings faster than its frames tell
// goes to and fro, too, but hardly ever to where it was.
bool goes_to_and_fro(CheckSubject& subject, int first, double fps);

// Of what does: whether neighbours change places as the squares of a chessboard, and do so again
// out of what lies between their two states, by and by: the mode of a difference scheme that an
// explicit step overshoots first (Courant, Friedrichs, Lewy, 1928; von Neumann's condition), to
// which no step needs to be told how long it is. Cells that follow rules are elsewhere at once.
bool grows_to_a_chessboard(CheckSubject& subject, int first, double fps);

}  // namespace glint
