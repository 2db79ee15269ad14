// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_PROGRAM_BLAS_H
#define HLSCM_PROGRAM_BLAS_H

namespace hlscm {

/// Ends the threads that OpenBLAS, if that is the BLAS of this machine, starts when the program does: they wait
/// busily at first, and the program has threads of its own. It then computes with one thread. Where there
/// is no memory for their buffers, see below, they stay, and wait.
void end_blas_threads();

/// Makes sure that CHOLMOD's BLAS has its memory. OpenBLAS, if that is the one of this machine, wants
/// a buffer of 128 MB of addresses for each thread that calls it, and asks for it for ever where
/// there is none. Returns how many threads may call it, at most `wanted` (0 is for all processors);
/// throws `std::bad_alloc` if none may. Other BLASs need nothing.
unsigned int reserve_blas_memory(unsigned int wanted);

} // namespace hlscm

#endif // HLSCM_PROGRAM_BLAS_H
