/* What the bodies of a model and the search share: the tables of the model, and one run of a body.
 *
 * The meaning of each instruction is in machine.py. Values are cells, as program.py says.
 */
#ifndef REBSYNC_MACHINE_H
#define REBSYNC_MACHINE_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef int64_t cell;

#define NO_DEADLINE (INT64_C(1) << 62)
#define FOREVER INT32_MAX
#define WAYS (1 << 20)
#define DEPTH 10000

/* How a run ends; AGAIN: not yet, the body at `pc` goes on. */
enum status { DONE, AGAIN, DELAYED, FAILED, ENDLESS };

/* Why a body is given up, in the order of endless.py. */
enum cause { REPEATS, INSTRUCTIONS, CALLS, CHOICES };

/* The order of FailureKind in steps.py, from 1 on. */
enum failure { ASSERTION = 1, DEADLINE, OVERFLOW, INDEX, DIVISION, NOBODY, TIME };

/* The cells of a message, in their order of comparison. */
enum message { ARRIVAL, SERVER, SENDER, DUE, ARGUMENTS };

/* The cells of a message on its way. */
enum sent { RECEIVER, SENT_BY, CHOICES_BEFORE, MESSAGE };

struct frame {
    int32_t pc;
    size_t base;
};

struct machine {
    cell *variables;
    cell *stack;
    const cell *message;
    const cell *const *states; /* the variables of each rebec, for predicates */
    unsigned char *covered;    /* for each branch: two bytes, not jumped and jumped */
    cell clock, elapsed, delayed;
    int64_t budget, slice, left; /* instructions: of this slice, still; at first; after it */
    int64_t room, places;
    size_t base, top, stack_room;
    struct frame *frames;
    size_t depth, frames_room;
    int32_t *choices, *options;
    size_t given, chosen, choices_room;
    cell *sends;
    size_t sent, sends_room;
    int32_t stride; /* cells of a message */
    int32_t index, pc, failure;
    int splits, exhausted, cause;
    void *kernel;
    int (*more)(struct machine *, int32_t pc, int32_t count, size_t top);
};

struct rebec {
    int32_t cells, capacity, priority;
    int32_t constructor; /* a body, or -1 */
    int32_t argument_count;
    const cell *arguments, *blank;
};

struct server {
    int32_t body, priority, arguments;
    int32_t depth; /* of its messages from other rebecs so many wait at most; 0: all */
};

struct body {
    int32_t entry, frame, need; /* cells: of its frame, and with all operands */
};

struct model {
    int32_t rebecs, servers, bodies, predicates, branches, stride, global_ranks, reads_clock, measures;
    const struct rebec *rebec;
    const struct server *server;
    const struct body *body;
    const int32_t *predicate; /* bodies, those of measures behind them */
    const unsigned char *observed; /* for each rebec: whether predicates read it */
    const int32_t *body_of;   /* by instruction */
    const int32_t *live;      /* by instruction: the cells in scope of a call or delay */
    int (*run)(struct machine *);
};

/* Makes room for `wanted` items of a growing array; 0 when there is no memory. */
static inline int enough(void **items, size_t *room, size_t wanted, size_t size)
{
    if (wanted <= *room)
        return 1;
    size_t more = wanted + wanted / 2 + 16;
    void *moved = realloc(*items, more * size);
    if (!moved)
        return 0;
    *items = moved;
    *room = more;
    return 1;
}

#endif
