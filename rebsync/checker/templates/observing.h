/* What predicates and measures read, and their values. */
#ifndef REBSYNC_OBSERVING_H
#define REBSYNC_OBSERVING_H

#include "outcomes.h"

/* The variables of a rebec as predicates read them. */
static const cell *observe(struct kernel *k, uint32_t rebec, uint32_t id)
{
    struct observed *o = k->observed + rebec;
    size_t cells = k->model->rebec[rebec].cells;
    cell *at = o->variables + (id % OBSERVED) * cells;
    if (o->ids[id % OBSERVED] != id) {
        const unsigned char *from =
            (unsigned char *)k->actors[rebec].bytes.data + component(k, rebec, id)->at;
        for (size_t i = 0; i < cells; i++)
            at[i] = take_number(&from);
        o->ids[id % OBSERVED] = id;
    }
    return at;
}

static void observe_state(struct kernel *k, const uint32_t *ids)
{
    for (uint32_t r = 0; r < k->rebecs; r++)
        if (k->model->observed[r])
            k->views[r] = observe(k, r, ids[r]);
}

/* Runs a predicate or measure on the state observed last. */
static struct valuation valuation_of(struct kernel *k, int32_t number)
{
    struct machine *m = &k->machine;
    m->covered = k->uncounted;
    m->index = -1;
    m->clock = m->elapsed = 0;
    m->depth = m->chosen = m->given = m->sent = 0;
    m->exhausted = 0;
    begin_count(k);
    start(k, k->model->predicate[number], NULL, 0);
    int status = k->model->run(m);
    m->covered = k->covered;
    if (m->exhausted)
        give_up(k->escape);
    return (struct valuation){COMPLETE, status == DONE, m->stack[0], m->failure, m->pc};
}

#endif
