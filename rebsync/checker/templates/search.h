/* What a search keeps. Of states it sees what kernel.h shows. */
#ifndef REBSYNC_SEARCH_H
#define REBSYNC_SEARCH_H

#include "fingerprints.h"
#include "trail.h"

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

/* A step on its way into the visited set; its state, packed, lies beside it. `kind` is DEADLOCK when
 * nothing can follow that, or of the failure that is there instead; else 0. */
struct pending {
    uint32_t parent, code; /* of a step: its ordinal, and its turn */
    int32_t pc;
    int32_t rebec : 27, kind : 5;
};

struct batch {
    struct pending *steps;
    uint64_t *words;
    uint32_t count;
};

/* Where a state is sought in the visited set, and when it is reached. */
struct sought {
    uint64_t hash;
    int64_t time;
};

/* States of the frontier, packed; those in front are expanded. Times are those of arrival. */
struct states {
    struct vector packed, times;
    uint64_t expanded, count;
};

/* States on the disk. */
struct chunks {
    FILE *file;
    uint64_t chunks;
};

/* The queue of states that wait, see frontier.h. */
struct frontier {
    struct states head, tail;
    struct chunks in, out;
    size_t collect_at; /* bytes of local states */
    size_t *first;     /* where the numbers of each rebec begin in `numbers` */
    struct vector numbers, content;
    struct field *fields; /* of the chunk that is read */
};

/* Why a search is left in the middle of a step, besides what the kernel answers. */
enum { VIOLATED = INTERRUPTED + 1 };

struct search {
    const struct model *model;
    struct kernel *kernel;
    int compact, symmetric;
    uint32_t rebecs;

    struct field *fields;
    uint32_t words;
    int wide; /* a number does not fit its field any more */
    _Alignas(LINES) struct vector states, parents, times; /* from here on: of who stores */
    uint64_t count, expanded, transitions, dropped, level_end, initials;
    uint64_t depth;
    uint32_t *table;
    uint64_t slots;
    uint32_t number_bits;
    struct fingerprints prints; /* with `compact`, instead of states, parents and table */
    struct trail trail;
    struct frontier frontier;
    int exhausted; /* there was no more memory: the search does not go on */
    int stopped; /* a search that was ended in the middle of a step does not go on */

    struct batch batch;
    struct sought sought[BATCH];

    uint32_t *ids, *unpacked;
    int beginning; /* the states that are stored are initial */
    int64_t until;

    struct vector events;
    int32_t *invariants; /* predicates */
    uint32_t invariant_count;
    struct measured *measured;
    int first; /* the search ends at the first violation: at one of these predicates, for example */
    int32_t *faults;
    uint32_t fault_count;
    int deadlock_is_fault, violated;
    int judged_later; /* what predicates say of states that are stored */
    void (*look)(int *goes_on);
    struct pipeline *pipeline; /* NULL: one thread searches */
    struct escape *escape, outermost;
};

/* Leaves the search if the kernel could not do all. */
static inline void expect(struct search *s, enum answer answer)
{
    if (answer != COMPLETE)
        longjmp(s->escape->to, answer);
}

#endif
