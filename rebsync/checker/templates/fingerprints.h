/* Hash compaction: of a visited state its fingerprint of 64 bits is kept, and nothing else.
 *
 * Two states with one fingerprint are taken for one, so that states may be missed (Wolper & Leroy
 * 1993; Stern & Dill 1995); how likely that is compiled.py says.
 *
 * The set is one array of slots in as many parts as a byte has values, all with equal room. The first
 * byte of a fingerprint says its part, so that the seven others are all that a slot holds (quotients:
 * Knuth, volume 3, exercise 6.4-13). Linear probing goes round in the part.
 */
#ifndef REBSYNC_FINGERPRINTS_H
#define REBSYNC_FINGERPRINTS_H

#include "common.h"

enum { PARTS = 256, SLOT = 7 };

struct fingerprints {
    unsigned char *slots; /* seven bytes each, all 0 when free */
    uint64_t room;        /* slots in each part */
    uint64_t counts[PARTS];
};

static inline unsigned char *slot_at(const struct fingerprints *f, uint64_t part, uint64_t at)
{
    return f->slots + (part * f->room + at) * SLOT;
}

static inline uint64_t read_slot(const unsigned char *slot)
{
    uint32_t low;
    uint16_t high;
    memcpy(&low, slot, sizeof low);
    memcpy(&high, slot + sizeof low, sizeof high);
    return low | (uint64_t)high << 32 | (uint64_t)slot[SLOT - 1] << 48;
}

static inline void write_slot(unsigned char *slot, uint64_t rest)
{
    uint32_t low = (uint32_t)rest;
    uint16_t high = (uint16_t)(rest >> 32);
    memcpy(slot, &low, sizeof low);
    memcpy(slot + sizeof low, &high, sizeof high);
    slot[SLOT - 1] = (unsigned char)(rest >> 48);
}

/* What a slot holds of a fingerprint: seven bytes that are not all 0. */
static inline uint64_t rest_of(uint64_t print)
{
    uint64_t rest = print & (~UINT64_C(0) >> 8);
    return rest ? rest : 1;
}

/* Where the search for it begins. */
static inline uint64_t home_of(const struct fingerprints *f, uint64_t rest)
{
    return (uint64_t)(((unsigned __int128)(rest << 8) * f->room) >> 64);
}

/* The slot that holds it, or the free one where it would be. */
static inline unsigned char *probe(const struct fingerprints *f, uint64_t part, uint64_t rest)
{
    uint64_t at = home_of(f, rest), held;
    unsigned char *slot = slot_at(f, part, at);
    while ((held = read_slot(slot)) && held != rest) {
        at = at + 1 == f->room ? 0 : at + 1;
        slot = slot_at(f, part, at);
    }
    return slot;
}

/* Memory that grows without a copy, which would double what is needed; NULL if it cannot. */
static void *grown(void *data, size_t before, size_t size)
{
#ifdef __linux__
    void *moved = data ? mremap(data, before, size, MREMAP_MAYMOVE)
                       : mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (moved == MAP_FAILED)
        return NULL;
    madvise(moved, size, MADV_HUGEPAGE); /* all of it, so that it can grow again */
    return moved;
#else
    (void)before;
    return realloc(data, size);
#endif
}

/* Grows by an eighth where it lies: parts are spread from the last to the first, so that none is
 * written over that is still to be read. */
static void enlarge_prints(struct escape *out, struct fingerprints *f)
{
    uint64_t before = f->room, size = before * SLOT, room = before + before / 8 + STEP;
    unsigned char *part = malloc(size + 1);
    unsigned char *slots = part ? grown(f->slots, PARTS * size, PARTS * room * SLOT) : NULL;
    if (!slots) {
        free(part);
        give_up(out);
    }
    f->slots = slots;
    f->room = room;
    for (uint64_t p = PARTS; p-- > 0;) {
        memcpy(part, slots + p * size, size);
        memset(slot_at(f, p, 0), 0, room * SLOT);
        for (uint64_t at = 0; at < before; at++) {
            uint64_t rest = read_slot(part + at * SLOT);
            if (rest)
                write_slot(probe(f, p, rest), rest);
        }
    }
    free(part);
}

/* Inserts a fingerprint; 0 when it is there already. */
static int insert_print(struct escape *out, struct fingerprints *f, uint64_t print)
{
    uint64_t part = print >> 56, rest = rest_of(print);
    if (8 * (f->counts[part] + 1) > 7 * f->room)
        enlarge_prints(out, f);
    unsigned char *slot = probe(f, part, rest);
    if (read_slot(slot))
        return 0;
    write_slot(slot, rest);
    f->counts[part]++;
    return 1;
}

static inline void prefetch_print(const struct fingerprints *f, uint64_t print)
{
    if (f->room)
        __builtin_prefetch(slot_at(f, print >> 56, home_of(f, rest_of(print))), 1);
}

static size_t size_of_prints(const struct fingerprints *f)
{
    return PARTS * f->room * SLOT;
}

static void free_prints(struct fingerprints *f)
{
#ifdef __linux__
    if (f->slots)
        munmap(f->slots, size_of_prints(f));
#else
    free(f->slots);
#endif
    *f = (struct fingerprints){0};
}

#endif
