/* Which step has led to each state, in a temporary file: about a byte a state.
 *
 * Breadth-first search finds states in the order of their parents. So an entry is the code of the step
 * and how much further the parent lies than that of the state before, and parents are known again by
 * adding up, from the last entry whose place is kept.
 */
#ifndef REBSYNC_TRAIL_H
#define REBSYNC_TRAIL_H

#include <stdio.h>

#include "common.h"

enum { NEAR = 7 }; /* parents that lie less far on are in the first number of their entry */

/* Where an entry begins, and the parent that it counts from. */
struct mark {
    uint64_t at, parent;
};

struct trail {
    FILE *file;
    uint64_t states, length, parent;
    struct vector marks; /* one for every STRETCH states */
};

/* The step to a state: from its parent, by its code; to an initial state a code alone. */
struct arrival {
    uint64_t parent, code;
};

static void put_far(struct escape *out, struct trail *t, uint64_t number)
{
    for (;; number >>= 7) {
        int more = number >= 128;
        if (putc((int)(number & 127) | more << 7, t->file) == EOF)
            give_up(out);
        t->length++;
        if (!more)
            return;
    }
}

static int take_far(FILE *file, uint64_t *number)
{
    *number = 0;
    for (int shift = 0;; shift += 7) {
        int byte = getc(file);
        if (byte == EOF)
            return 0;
        *number |= (uint64_t)(byte & 127) << shift;
        if (byte < 128)
            return 1;
    }
}

/* Notes the step to the next state, whose parent is that of the last one or comes later. */
static void write_arrival(struct escape *out, struct trail *t, struct arrival arrival)
{
    uint64_t further = arrival.parent - t->parent;
    if (t->states % STRETCH == 0)
        *(struct mark *)added(out, &t->marks, sizeof(struct mark)) = (struct mark){t->length, t->parent};
    put_far(out, t, arrival.code * (NEAR + 1) + (further < NEAR ? further : NEAR));
    if (further >= NEAR)
        put_far(out, t, further - NEAR);
    t->parent = arrival.parent;
    t->states++;
}

/* Reads the step to a state; 0 when that cannot be. */
static int read_arrival(struct trail *t, uint64_t state, struct arrival *arrival)
{
    if (state >= t->states)
        return 0;
    struct mark from = ((struct mark *)t->marks.data)[state / STRETCH];
    uint64_t first, further;
    int found = !fseeko(t->file, (off_t)from.at, SEEK_SET);
    arrival->parent = from.parent;
    for (uint64_t i = state - state % STRETCH; found && i <= state; i++) {
        found = take_far(t->file, &first);
        further = first % (NEAR + 1);
        if (found && further == NEAR) {
            found = take_far(t->file, &further);
            further += NEAR;
        }
        arrival->code = first / (NEAR + 1);
        arrival->parent += further;
    }
    return !fseeko(t->file, (off_t)t->length, SEEK_SET) && found;
}

/* Begins anew. */
static void clear_trail(struct trail *t)
{
    rewind(t->file);
    t->states = t->length = t->parent = t->marks.count = 0;
}

static void free_trail(struct trail *t)
{
    if (t->file)
        fclose(t->file);
    free(t->marks.data);
}

#endif
