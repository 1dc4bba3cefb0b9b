/* Hash compaction: of a visited state its fingerprint of 64 bits is kept, and nothing else.
 *
 * Two states with one fingerprint are taken for one, so that states may be missed (Wolper & Leroy
 * 1993; Stern & Dill 1995); how likely that is compiled.py says.
 *
 * The set is one array of slots in as many parts as a byte has values, all with equal room. The first
 * byte of a fingerprint says its part, so that the seven others are all that a slot holds (quotients:
 * Knuth, volume 3, exercise 6.4-13). Linear probing goes round in the part, in the order
 * of homes (Robin Hood hashing: Celis 1985), which ends a search after few slots in a full table.
 */
#ifndef REBSYNC_FINGERPRINTS_H
#define REBSYNC_FINGERPRINTS_H

#include "common.h"

enum { PARTS = 256, SLOT = 7, LARGE_FROM = 1 << 25 };

#define MOST_SLOTS ((size_t)5 << 30) /* for 2^32 states */

struct fingerprints {
    unsigned char *slots; /* seven bytes each, all 0 when free */
    uint64_t room;        /* slots in each part */
    uint64_t counts[PARTS];
    size_t reserved;      /* bytes of addresses */
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

static inline uint64_t slot_behind(const struct fingerprints *f, uint64_t at)
{
    return at + 1 == f->room ? 0 : at + 1;
}

/* Frees a slot: those from there up to the next free one move on by one. */
static void make_place(struct fingerprints *f, uint64_t part, uint64_t at)
{
    unsigned char *slots = slot_at(f, part, 0);
    uint64_t end = at;
    while (read_slot(slots + end * SLOT))
        end = slot_behind(f, end);
    if (end < at) {
        memmove(slots + SLOT, slots, end * SLOT);
        end = f->room - 1;
        memcpy(slots, slots + end * SLOT, SLOT);
    }
    memmove(slots + (at + 1) * SLOT, slots + at * SLOT, (end - at) * SLOT);
}

/* Puts it into a part that has a free slot; 0 when it is there. It is not where one begins that lies
 * less far from its home. */
static int insert_rest(struct fingerprints *f, uint64_t part, uint64_t rest)
{
    uint64_t at = home_of(f, rest), held;
    for (uint64_t far = 0; (held = read_slot(slot_at(f, part, at))); far++) {
        if (held == rest)
            return 0;
        uint64_t home = home_of(f, held);
        if (at - home + (at < home ? f->room : 0) < far)
            break;
        at = slot_behind(f, at);
    }
    if (held)
        make_place(f, part, at);
    write_slot(slot_at(f, part, at), rest);
    return 1;
}

/* Memory for slots that stays where it is when it grows: a copy would double what is needed, and
 * moving it would break up large pages. Linux gives addresses for the most that may come, or as many
 * as it allows, and memory when it is written. NULL if there is no more. */
static unsigned char *room_for_slots(struct fingerprints *f, size_t size)
{
#ifdef __linux__
    enum { KINDS = PROT_READ | PROT_WRITE, FLAGS = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE };
    for (size_t most = MOST_SLOTS * SLOT; !f->slots && most >= size; most /= 2) {
        void *reserved = mmap(NULL, most, KINDS, FLAGS, -1, 0);
        if (reserved != MAP_FAILED)
            f->slots = reserved;
        f->reserved = most;
    }
    if (!f->slots || size > f->reserved)
        return NULL;
    if (size >= LARGE_FROM) /* the last large page may be nearly empty */
        in_large_pages(f->slots, f->reserved);
    return f->slots;
#else
    return realloc(f->slots, size);
#endif
}

/* Grows by an eighth where it lies: parts are spread from the last to the first, so that none is
 * written over that is still to be read. */
static void enlarge_prints(struct escape *out, struct fingerprints *f)
{
    uint64_t before = f->room, size = before * SLOT, room = before + before / 8 + STEP;
    unsigned char *part = malloc(size + 1);
    unsigned char *slots = part ? room_for_slots(f, PARTS * room * SLOT) : NULL;
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
                insert_rest(f, p, rest);
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
    int is_new = insert_rest(f, part, rest);
    f->counts[part] += (uint64_t)is_new;
    return is_new;
}

/* Where it is sought first: to be fetched by the caller, as compilers leave out calls that do no
 * more than that. */
static inline const unsigned char *place_of_print(const struct fingerprints *f, uint64_t print)
{
    return slot_at(f, print >> 56, home_of(f, rest_of(print)));
}

static size_t size_of_prints(const struct fingerprints *f)
{
    return PARTS * f->room * SLOT;
}

static void free_prints(struct fingerprints *f)
{
#ifdef __linux__
    if (f->slots)
        munmap(f->slots, f->reserved);
#else
    free(f->slots);
#endif
    *f = (struct fingerprints){0};
}

#endif
