// Ctrl-C, noticed between frames so that what is finished can be kept.
#pragma once

namespace ringlet::program {

/// From now on the first Ctrl-C (or SIGTERM) only sets a flag; the second ends the program at once.
void catchInterruption();

/// Whether it has come.
bool wasInterrupted();

}  // namespace ringlet::program
