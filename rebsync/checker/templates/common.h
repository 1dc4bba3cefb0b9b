/* What the kernel and the search share: memory that grows, hashes, the clock, how much tables hold. */
#ifndef REBSYNC_COMMON_H
#define REBSYNC_COMMON_H

#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

#include "kernel.h"

/* How much tables and memories hold, at first or at most, and how often the search looks up. With
 * little of all that, small systems show whether what is full is handled rightly. */
#ifdef LITTLE_ROOM
enum { BATCH = 3, OBSERVED = 2, MEMO = 2, MEMO_AT_MOST = 8, MEMO_BESIDE = 4, TABLE = 8, SLOTS = 8, TURNS = 2 };
enum { STEP = 1, STRETCH = 3, LEAST = 500, BESIDE = 8 };
enum { PORTION = 3, PORTIONS = 2, ROUND = 64, ROUND_AT_LEAST = 2 };
#else
enum { BATCH = 64, OBSERVED = 1024, TABLE = 256 };
enum { MEMO = 1024, MEMO_AT_MOST = 1 << 18, MEMO_BESIDE = 1 << 16 };
enum { SLOTS = 1 << 14, TURNS = 256 };
enum { STEP = 64, STRETCH = 4096, LEAST = 1 << 21, BESIDE = 8 };
enum { PORTION = 512, PORTIONS = 64, ROUND = 1 << 20, ROUND_AT_LEAST = 2048 };
#endif

#define NEVER INT64_MAX

/* Bytes of memory that go from one processor to another together, with what is fetched beside them. */
enum { LINES = 128 };

static int64_t clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* Where to go on when something cannot be ended as usual: NO_MEMORY, for example. */
struct escape {
    jmp_buf to;
};

struct vector {
    char *data;
    size_t count, room;
};

/* There is no memory. */
static void give_up(struct escape *out)
{
    longjmp(out->to, NO_MEMORY);
}

static void *room_for(struct escape *out, struct vector *v, size_t count, size_t size)
{
    if (count > v->room) {
        size_t room = count + count / 2 + 64;
        char *moved = realloc(v->data, room * size);
        if (!moved) { /* little more: each attempt is dear when memory is short */
            room = count + count / 128;
            moved = realloc(v->data, room * size);
        }
        if (!moved)
            give_up(out);
        v->data = moved;
        v->room = room;
    }
    return v->data;
}

/* A new item at the end. */
static void *added(struct escape *out, struct vector *v, size_t size)
{
    room_for(out, v, v->count + 1, size);
    return v->data + v->count++ * size;
}

/* Asks for large pages for what is read here and there; the places of small ones would not stay in
 * the processor. Not for what grows, which would take more memory. */
static void *in_large_pages(void *data, size_t size)
{
#ifdef MADV_HUGEPAGE
    enum { LARGE = 1 << 22, PAGE = 1 << 12 };
    uintptr_t from = ((uintptr_t)data + PAGE - 1) & ~(uintptr_t)(PAGE - 1);
    uintptr_t to = ((uintptr_t)data + size) & ~(uintptr_t)(PAGE - 1);
    if (size >= LARGE)
        madvise((void *)from, to - from, MADV_HUGEPAGE);
#endif
    return data;
}

static void *zeroed(struct escape *out, size_t count, size_t size)
{
    void *made = calloc(count ? count : 1, size);
    if (!made)
        give_up(out);
    return in_large_pages(made, count * size);
}

/* The same for what begins where lines do; NULL without memory. */
static void *zeroed_lines(size_t count, size_t size)
{
    void *made = aligned_alloc(LINES, count * size);
    return made ? memset(made, 0, count * size) : NULL;
}

static int32_t *copied(struct escape *out, const int32_t *numbers, size_t count)
{
    int32_t *copy = zeroed(out, count, sizeof *copy);
    memcpy(copy, numbers, count * sizeof *copy);
    return copy;
}

static inline uint64_t mixed(uint64_t a, uint64_t b)
{
    unsigned __int128 product = (unsigned __int128)(a ^ UINT64_C(0x9E3779B97F4A7C15)) *
                                (b ^ UINT64_C(0xD1B54A32D192ED03));
    return (uint64_t)product ^ (uint64_t)(product >> 64);
}

static uint64_t hash_of(const void *data, size_t size)
{
    const char *bytes = data;
    uint64_t hash = size, word;
    for (; size >= 8; size -= 8, bytes += 8) {
        memcpy(&word, bytes, 8);
        hash = mixed(hash, word);
    }
    word = 0;
    memcpy(&word, bytes, size);
    return mixed(mixed(hash, word), UINT64_C(0xA0761D6478BD642F));
}

#endif
