// Goes to a place in a Neovim that runs, over its socket (the MessagePack-RPC of `:help api`).
#pragma once

#include "base/diagnostic.h"

#include <string>

namespace glint {

// Whether a Neovim shows the place now. Which one: that at `address` (what `nvim --server` takes),
// if it is not empty; else that in whose terminal glint was started ($NVIM), or of
// $NVIM_LISTEN_ADDRESS; else one of this user that has the file loaded. One that does not answer,
// because it asks its person something, is passed over after 0.3 s in all.
bool jump_in_neovim(const std::string& address, const Place& place);

}  // namespace glint
