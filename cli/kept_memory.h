// Memory for processes that live for some tens of milliseconds: a twentieth of them went into
// giving it back and asking for it again.
#pragma once

namespace sinew::cli {

// From now on this process keeps what it frees. For the beginning of main().
void keep_memory();

}  // namespace sinew::cli
