// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_IS_SANITIZED_H
#define HLSCM_TEST_SUPPORT_IS_SANITIZED_H

namespace test_support {

// Whether sanitizers make tests ten times as slow: then long ones take fewer or smaller meshes.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#else
constexpr bool is_sanitized = false;
#endif

} // namespace test_support

#endif // HLSCM_TEST_SUPPORT_IS_SANITIZED_H
