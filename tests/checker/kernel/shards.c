/* A search by three kernels that each own a share of the states and send each other the rest, as
 * processes would: a state goes from one to another as the contents of its local states.
 *
 *     shards tts|ftts|core
 *
 * Prints `states transitions failures`. */
#include <stdio.h>

#include "kernel.h"
#include "common.h"

extern const struct model rebsync_model;

enum { SHARES = 3, MOST = 1 << 16, LONGEST = 1 << 16, TOGETHER = 5 };

/* The states of a share: contents, one for each rebec, each behind its length. */
static struct share {
    struct kernel *kernel;
    unsigned char *states[MOST];
    size_t lengths[MOST], count, expanded;
} shares[SHARES];

static uint64_t transitions, failures;

static void must(int holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "shards: %s\n", what);
    exit(3);
}

/* Takes a state in unless it is known. */
static void receive(struct share *s, const unsigned char *text, size_t length)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->lengths[i] == length && !memcmp(s->states[i], text, length))
            return;
    must(s->count < MOST, "too many states");
    memcpy(s->states[s->count] = malloc(length), text, length);
    s->lengths[s->count++] = length;
}

static void give(void *from, const struct transition *step)
{
    static unsigned char text[LONGEST];
    struct kernel *k = from;
    size_t length = 0;
    transitions++;
    if (!step->state) {
        failures++;
        return;
    }
    for (uint32_t r = 0; r < (uint32_t)rebsync_model.rebecs; r++) {
        const unsigned char *content;
        size_t size = kernel_content(k, r, step->state[r], &content);
        must(length + sizeof size + size < LONGEST, "too long a state");
        memcpy(text + length, &size, sizeof size);
        memcpy(text + length + sizeof size, content, size);
        length += sizeof size + size;
    }
    uint64_t print = kernel_fingerprint(k, step->state);
    receive(shares + kernel_owner(print, SHARES), text, length);
}

/* The state of a share in its kernel's numbers; it belongs there. */
static void numbered(struct share *s, size_t state, uint32_t *into)
{
    const unsigned char *at = s->states[state];
    for (uint32_t r = 0; r < (uint32_t)rebsync_model.rebecs; r++) {
        size_t size;
        memcpy(&size, at, sizeof size);
        into[r] = kernel_number(s->kernel, r, at + sizeof size);
        at += sizeof size + size;
    }
    uint64_t print = kernel_fingerprint(s->kernel, into);
    must(kernel_owner(print, SHARES) == (uint32_t)(s - shares), "one fingerprint in all kernels");
}

/* Expands some states of a share at once; whether there were any. */
static int expand_some(struct share *s)
{
    size_t rebecs = (size_t)rebsync_model.rebecs, count = 0, made = 0;
    uint32_t *batch = malloc(TOGETHER * rebecs * sizeof *batch);
    for (; count < TOGETHER && s->expanded < s->count; count++)
        numbered(s, s->expanded++, batch + count * rebecs);
    enum answer answer = kernel_successors(s->kernel, batch, count, &made, give, s->kernel);
    must(answer == COMPLETE && made == count, "all steps");
    free(batch);
    return count > 0;
}

int main(int count, char **arguments)
{
    must(count == 2, "one view");
    enum semantics view = arguments[1][0] == 't' ? TTS : arguments[1][0] == 'f' ? FTTS : CORE;
    for (int i = 0; i < SHARES; i++) /* with hashes and without */
        must((shares[i].kernel = kernel_new(&rebsync_model, view, i % 2)) != NULL, "memory");
    must(kernel_initial(shares[0].kernel, give, shares[0].kernel) == COMPLETE, "initial states");
    transitions = 0;
    for (int busy = 1; busy;) {
        busy = 0;
        for (int i = 0; i < SHARES; i++)
            busy |= expand_some(shares + i);
    }
    uint64_t states = 0;
    for (int i = 0; i < SHARES; i++) {
        states += shares[i].count;
        kernel_free(shares[i].kernel);
    }
    printf("%ju %ju %ju\n", (uintmax_t)states, (uintmax_t)transitions, (uintmax_t)failures);
    return 0;
}

#include "kernel.c"
