// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_WEB_EXPORTED_H
#define HLSCM_WEB_EXPORTED_H

// EXPORTED: a function that a module of WebAssembly shows by its name; one of C for other compilers.
#if defined(__EMSCRIPTEN__)
#include <emscripten/emscripten.h>
#define EXPORTED extern "C" EMSCRIPTEN_KEEPALIVE
#else
#define EXPORTED extern "C"
#endif

#endif // HLSCM_WEB_EXPORTED_H
