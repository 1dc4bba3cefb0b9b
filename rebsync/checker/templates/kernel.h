/* The kernel: a model as a transition system.
 *
 * All that walks through the states of a model does it by these functions: the search (runtime.c),
 * runs and graphs made afterwards, and the language module for other checkers (pins.c). What a
 * step is, is in kernel.c and what that includes, and nowhere else; whoever includes this file alone
 * sees nothing of it.
 *
 * A state is an array of as many numbers as there are rebecs: for each the number of its local state
 * (variables, bag, time, suspended body). Numbers count from 0 in the order in which local states are
 * met; they are those of one kernel, and mean nothing in another. The content of a local state is a
 * text of bytes, which is the same in all kernels of a model: states go from one kernel to another, to
 * another process or to a file as one content for each rebec (`kernel_content`, `kernel_number`).
 *
 * Kernels share nothing but the model, which is constant: threads have one each. No function may be
 * called by two threads at once for one kernel.
 */
#ifndef REBSYNC_KERNEL_H
#define REBSYNC_KERNEL_H

#include "machine.h"

#define NONE UINT32_MAX

/* What each does is known where it is compiled; libraries show no more than they say. */
#pragma GCC visibility push(hidden)

struct kernel;

enum semantics { TTS, FTTS, CORE };

/* How a call ends. INTERRUPTED: who watches wants no more. UNENDING: a body was given up, see
 * `kernel_cut`. The steps that were visited by then are those in front; a kernel without memory is
 * only asked for what it knows, and freed. */
enum answer { COMPLETE, NO_MEMORY, UNENDING, INTERRUPTED };

/* A step, to a state or to a failure. */
struct transition {
    const uint32_t *state; /* what is reached, valid during the visit; NULL: the step fails */
    uint64_t code;         /* of the step among those of its state, ascending */
    int64_t time;          /* that passes in it */
    int32_t actor;         /* the rebec that acts; -1: time passes, or this is an initial state */
    int32_t deadlock;      /* whether nothing can follow the state */
    int32_t kind, pc, rebec; /* of the failure: machine.h, the instruction, and whose it is */
    uint32_t turn;           /* by which permutation the state is canonical, see orbits.h */
};

/* May call kernel functions that make no steps, and may leave by longjmp: the kernel stays usable. */
typedef void visit(void *visitor, const struct transition *step);

/* --- its life */

/* A kernel of a model; `hashes`: fingerprints are wanted often, so hashes of contents are kept, at 8
 * bytes a local state, and fewer results are remembered. NULL without memory. */
struct kernel *kernel_new(const struct model *model, enum semantics semantics, int hashes);
void kernel_free(struct kernel *k);

/* A body that runs more instructions is given up. */
void kernel_limit(struct kernel *k, int64_t instructions);

/* Who is asked now and then, by steps that take long, whether to go on; NULL: nobody. */
void kernel_watch(struct kernel *k, void (*look)(int *goes_on));

/* In states where one of these rebecs can act and nobody that disturbs it, only it acts: for each of
 * `count` candidates its number, and for each rebec whether that disturbs it. 0 without memory. */
int kernel_persistent(struct kernel *k, const int32_t *candidates, int count);

/* What is known of symmetries, see orbits.h; `order` is 1 when there are none. */
struct symmetries {
    uint32_t order, movable, references;
};

/* States become canonical ones of their orbits, by the tables of orbits.h; 0 without memory. */
int kernel_symmetry(struct kernel *k, struct symmetries found, const int32_t *names,
                    const int32_t *origins, const int32_t *positions, const int32_t *orbit,
                    const int32_t *references);

/* --- steps */

/* Visits the initial states, each as often as there are ways to it, and failures of constructors. */
enum answer kernel_initial(struct kernel *k, visit *to, void *visitor);

/* Visits the steps of each of `count` states that lie one behind the other. When one of them cannot be
 * made whole it ends there; `made` is how many were. */
enum answer kernel_successors(struct kernel *k, const uint32_t *states, size_t count, size_t *made,
                              visit *to, void *visitor);

/* --- states */

/* 64 bits that depend on the contents of a state alone: in all kernels of the model the same. Not 0. */
uint64_t kernel_fingerprint(struct kernel *k, const uint32_t *state);

/* Which of so many shares of the state space a fingerprint belongs to. */
static inline uint32_t kernel_owner(uint64_t fingerprint, uint32_t shares)
{
    return (uint32_t)(((unsigned __int128)fingerprint * shares) >> 64);
}

/* The content of a local state, valid until the next call that may make new ones; gives its length. */
size_t kernel_content(struct kernel *k, uint32_t rebec, uint32_t number, const unsigned char **content);

/* The number of a local state by its content, which is one of this model; NONE without memory. */
uint32_t kernel_number(struct kernel *k, uint32_t rebec, const unsigned char *content);

/* Who is told of each new local state, from now on; it may not call the kernel. */
void kernel_meet(struct kernel *k, void (*meet)(void *of, uint32_t rebec, uint32_t number), void *of);

/* How many local states of a rebec are known. */
uint32_t kernel_locals(const struct kernel *k, uint32_t rebec);

/* --- what holds */

/* A value of a predicate or measure; where it has none, `kind` and `pc` say how it fails. */
struct valuation {
    enum answer answer;
    int defined;
    cell value;
    int32_t kind, pc;
};

/* Lets the next ones be of this state. */
void kernel_observe(struct kernel *k, const uint32_t *state);

/* The predicate or measure of a number in the state observed last; measures come behind. */
struct valuation kernel_evaluate(struct kernel *k, int32_t number);

/* --- what it knows */

/* Where and why a body was given up. */
struct cut {
    uint64_t cause, pc, outer;
};

struct cut kernel_cut(const struct kernel *k);

/* Copies which servers and branches ran, and the largest bags. */
void kernel_covered(const struct kernel *k, unsigned char *served, unsigned char *covered,
                    uint32_t *largest);

/* Lets what ran be that again, and forgets what else ran: it will run again. */
void kernel_forget(struct kernel *k, const unsigned char *served, const unsigned char *covered,
                   const uint32_t *largest);

/* Bytes that local states take, and what is known of them. */
size_t kernel_size(const struct kernel *k);

/* Gives up local states; only of kernels with hashes. `numbers` has one for each local state, those of
 * the first rebec first: 0 where it is not needed any more; the others get their new numbers. */
void kernel_collect(struct kernel *k, uint32_t *numbers);

#pragma GCC visibility pop

#endif
