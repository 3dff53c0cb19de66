/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wide vector instructions in a portable build: a function marked SW_HOT is compiled
 * for several instruction sets, and the loader picks one. SW_CLONES is defined if this compiler
 * can. */
#ifndef SW_BASE_SIMD_H
#define SW_BASE_SIMD_H

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(SW_NO_CLONES)
#define SW_HOT __attribute__((target_clones("default", "arch=x86-64-v3")))
#define SW_CLONES
#else
#define SW_HOT
#endif

#endif
