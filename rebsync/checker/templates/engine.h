/* What a search keeps, and its memory. */
#ifndef REBSYNC_ENGINE_H
#define REBSYNC_ENGINE_H

#include <setjmp.h>
#include <stdint.h>
#include <stdio.h>
#include <time.h>
#ifdef __linux__
#include <sys/mman.h>
#endif

#include "machine.h"

#define GLANCE 1000000 /* instructions between two looks at the clock */
#define PAUSE INT64_C(100000000) /* nanoseconds between two questions: longer than a slice */
#define STORING 500 /* the instructions that take as long as to deliver and store an outcome */

/* How much tables and memories hold, at first or at most, and how often the search looks up. With
 * little of all that, small systems show whether what is full is handled rightly. */
#ifdef LITTLE_ROOM
enum { BATCH = 3, OBSERVED = 2, MEMO = 2, MEMO_AT_MOST = 8, TABLE = 8, SLOTS = 8, TURNS = 2, GONE = 3 };
enum { SHARDS = 2, SHARD = 1, COLLECT = 500 };
#else
enum { BATCH = 64, OBSERVED = 1024, MEMO = 1024, MEMO_AT_MOST = 1 << 18, TABLE = 256 };
enum { SLOTS = 1 << 14, TURNS = 256, GONE = 4096 };
enum { SHARDS = 256, SHARD = 64, COLLECT = 1 << 22 };
#endif

#define NEVER INT64_MAX
#define NONE UINT32_MAX

enum semantics { TTS, FTTS, CORE };

/* What a component can do, see `describe`. */
enum flags { ABLE = 1, STILL = 2, STUCK = 4 };

struct vector {
    char *data;
    size_t count, room;
};

/* The state of one rebec, unpacked. `frames` has for each frame: pc, number of cells, cells. */
struct local {
    cell *variables, *bag, *message, *frames;
    cell busy, clock;
    size_t messages, bag_room, frame_count, frame_cells, frames_room;
};

/* A packed local state that occurs: bytes from `at` on, and what it means for the whole. */
struct component {
    uint64_t at;
    int64_t next;      /* when it will be able to act, NEVER if never */
    uint32_t outcomes; /* the first one, NONE when not known yet */
    int32_t rank;
    uint32_t places : 28, flags : 4;
};

/* A fixed-size memory of results: what falls out is computed again. */
struct memo {
    struct remembered {
        uint64_t key;
        uint32_t value;
    } *entries;
    uint64_t mask;
};

/* All local states of one rebec that occur, by number. */
struct actor {
    struct vector components, bytes, hashes; /* of contents, only for fingerprints */
    uint64_t *table; /* half of the hash above the number, which counts from 1; 0 is free */
    uint64_t mask;
    struct memo received, passed, renamed;
    uint32_t largest;
};

/* A way to act: a new component, or a failure, after `sends` went out to others.
 * `shared` choices are those of the outcome before; -1 at the first of a slot. */
struct outcome {
    uint32_t component, sends, send_count;
    int32_t shared, failure, pc;
    uint32_t last;
};

struct send {
    uint32_t receiver, message, choices, pc;
};

/* Where the number of a component lies in a packed state. */
struct field {
    uint64_t mask;
    uint32_t word, shift, width;
};

struct event {
    int32_t kind, pc, rebec;
    int64_t state, ordinal;
};

/* The extremes of a measure, each with the first state that has it; states are -1 for none. */
struct measured {
    int64_t least, least_state, greatest, greatest_state, undefined;
};

enum { PREDICATE = 8, DEADLOCK = 9 };

/* States on their way into the visited set; `event` is a failed step instead, or -1. */
struct pending {
    uint64_t hash;
    int64_t time;
    uint32_t parent, code; /* of a step: its ordinal, and its turn */
    int32_t event, deadlock;
};

/* A part of the table of fingerprints; 0 is a free slot. */
struct shard {
    uint64_t *prints, count, slots;
};

/* What has led to a state: a step from its parent, by its code; to an initial one a code alone. */
struct step {
    uint32_t parent, code;
};

enum purpose { SEARCH, START, PATH, GRAPH };

struct graph {
    uint64_t *first;
    int64_t *target;
    int32_t *actor;
    int64_t *time;
    uint64_t *labels;
    uint16_t *turn; /* of a quotient: by which permutation the target is canonical */
};

/* What is known of symmetries, see orbits.h; `order` is 1 when there are none. */
struct symmetries {
    uint32_t order, movable, references;
};

/* A cell that holds a rebec: a variable of a rebec, an argument of a server, or a cell of a frame
 * that goes on at an instruction, which is the `key`. */
enum reference_kind { OF_VARIABLE, OF_ARGUMENT, OF_FRAME };

struct reference {
    int32_t kind, key, cell;
};

/* The variables of some components of a rebec that predicates read, unpacked. */
struct observed {
    uint32_t ids[OBSERVED];
    cell *variables;
};

/* The state of a body that runs long, to be compared with later ones. */
struct watch {
    int on;
    int64_t from, to; /* instructions: when it is kept, and until when it is compared */
    int32_t pc, head;
    size_t depth, shallow, base, stack, chosen, sent;
    cell elapsed;
    struct vector cells, frames;
};

/* Where and why a body was given up. */
struct cut {
    uint64_t cause, pc, outer;
};

struct engine {
    const struct model *model;
    enum semantics semantics;
    int compact;
    uint32_t rebecs;
    struct machine machine;
    struct actor *actors;
    struct local scratch, result;
    struct vector text; /* a component being packed */
    struct vector messages, outcomes, sends, events;
    uint32_t *message_table;
    uint64_t message_mask;
    struct cut cut;
    struct watch watch;
    int64_t instructions; /* of one run of a body */

    struct field *fields;
    uint32_t words;
    int wide; /* a number does not fit its field any more */
    struct vector states, parents, times;
    uint64_t count, forgotten, expanded, transitions, dropped, level_end, initials;
    uint64_t depth;
    uint32_t *table;
    uint64_t slots;
    uint32_t number_bits;
    struct shard shards[SHARDS];
    FILE *steps;
    size_t collect_at; /* bytes of local states */
    int exhausted; /* there was no more memory: the search does not go on */

    struct pending batch[BATCH];
    struct event failed[BATCH];
    uint64_t *batch_words;
    uint32_t pending;

    uint32_t *ids, *next, *unpacked;
    enum purpose purpose;
    uint64_t current, ordinal; /* the state whose steps are made, and the number of the step */
    int64_t until;
    int64_t wanted, found; /* of a path: the state sought, and the ordinal */
    uint64_t edges;
    struct graph graph;

    struct symmetries symmetries;
    int32_t *names, *origins, *positions, *orbit; /* see orbits.h */
    struct reference *references;
    uint64_t *colours;
    uint32_t *turned, turn;

    int32_t *invariants; /* predicates */
    int32_t *persistent; /* rebecs that act alone, each with a mark for every one that disturbs it */
    uint32_t invariant_count, persistent_count;
    unsigned char *covered, *served, *uncounted;
    struct measured *measured;
    struct observed *observed;
    const cell **views;
    jmp_buf escape;

    void (*look)(int *goes_on); /* asked now and then by what takes long */
    int64_t looked, spent; /* when that was; what was done since the clock was read */
    int first; /* the search ends at the first violation: at one of these predicates, for example */
    int32_t *faults;
    uint32_t fault_count;
    int deadlock_is_fault, violated;
    int stopped; /* a search that was ended in the middle of a step does not go on */
};

/* Why the engine leaves what it is at in the middle of it. */
enum escape { NO_MEMORY = 1, STUCK_AT_START, ENDED, VIOLATED };

static int64_t clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* Asks whether to go on, after so many more instructions or what takes as long as them. */
static void glance(struct engine *e, int64_t instructions)
{
    if ((e->spent += instructions) < GLANCE)
        return;
    e->spent = 0;
    int64_t now = clock_now();
    if (!e->look || now < e->looked + PAUSE)
        return;
    e->looked = now;
    int goes_on = 0;
    e->look(&goes_on);
    if (!goes_on)
        longjmp(e->escape, ENDED);
}

/* Ends what the engine is at: there is no memory. */
static void give_up(struct engine *e)
{
    longjmp(e->escape, NO_MEMORY);
}

static void *room_for(struct engine *e, struct vector *v, size_t count, size_t size)
{
    if (count > v->room) {
        size_t room = count + count / 2 + 64;
        char *moved = realloc(v->data, room * size);
        if (!moved) {
            room = count;
            moved = realloc(v->data, room * size);
        }
        if (!moved)
            give_up(e);
        v->data = moved;
        v->room = room;
    }
    return v->data;
}

/* A new item at the end. */
static void *added(struct engine *e, struct vector *v, size_t size)
{
    room_for(e, v, v->count + 1, size);
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

static void *zeroed(struct engine *e, size_t count, size_t size)
{
    void *made = calloc(count ? count : 1, size);
    if (!made)
        give_up(e);
    return in_large_pages(made, count * size);
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
