/* What a kernel keeps. */
#ifndef REBSYNC_KERNEL_DATA_H
#define REBSYNC_KERNEL_DATA_H

#include "common.h"

#define GLANCE 1000000 /* instructions between two looks at the clock */
#define PAUSE INT64_C(100000000) /* nanoseconds between two questions: longer than a slice */
#define STORING 500 /* the instructions that take as long as to deliver and store an outcome */

/* What a component can do, see `describe`. */
enum flags { ABLE = 1, STILL = 2, STUCK = 4 };

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

/* A fixed-size memory of what becomes of local states: what falls out is computed again. An entry
 * has the result, and above it what its place does not say of the question. */
struct memo {
    uint64_t *entries;
    uint64_t mask;
    uint32_t bits;
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


struct kernel {
    const struct model *model;
    enum semantics semantics;
    int hashes;
    uint32_t rebecs;
    struct machine machine;
    struct actor *actors;
    struct local scratch, result;
    struct vector text; /* a component being packed */
    struct vector messages, outcomes, sends;
    uint32_t *message_table;
    uint64_t message_mask;
    struct cut cut;
    struct watch watch;
    int64_t instructions; /* of one run of a body */

    const uint32_t *ids; /* the state whose steps are made */
    uint32_t *next;      /* the one that a step leads to */
    uint32_t *acting;    /* who acts in it */
    int starting;        /* steps are those of constructors */
    uint64_t ordinal;    /* of the step */
    visit *visit;
    void *visitor;
    void (*meet)(void *of, uint32_t rebec, uint32_t number); /* NULL: nobody is told */
    void *meeter;

    int32_t *persistent; /* rebecs that act alone, each with a mark for every one that disturbs it */
    uint32_t persistent_count;
    struct symmetries symmetries;
    int32_t *names, *origins, *positions, *orbit; /* see orbits.h */
    struct reference *references;
    uint64_t *colours;
    uint32_t *turned, turn;

    unsigned char *covered, *served, *uncounted;
    struct observed *observed;
    const cell **views;

    struct escape *escape; /* of the call that goes on */
    void (*look)(int *goes_on);
    int64_t looked, spent; /* when that was; what was done since the clock was read */
};

/* Asks whether to go on, after so many more instructions or what takes as long as them. */
static void glance(struct kernel *k, int64_t instructions)
{
    if ((k->spent += instructions) < GLANCE)
        return;
    k->spent = 0;
    int64_t now = clock_now();
    if (!k->look || now < k->looked + PAUSE)
        return;
    k->looked = now;
    int goes_on = 0;
    k->look(&goes_on);
    if (!goes_on)
        longjmp(k->escape->to, INTERRUPTED);
}

#endif
