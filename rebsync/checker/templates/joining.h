/* What the workers of a round have found out, put together as one thread would have found it. */
#ifndef REBSYNC_JOINING_H
#define REBSYNC_JOINING_H

#include "gathering.h"

/* An event, and the step at which one thread would have met it. */
struct met {
    struct event event;
    int64_t parent, code;
    size_t order; /* of those of one step */
};

static int compare_met(const void *one, const void *other)
{
    const struct met *a = one, *b = other;
    if (a->parent != b->parent)
        return a->parent < b->parent ? -1 : 1;
    if (a->code != b->code)
        return a->code < b->code ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

static void gather_events(struct search *s, struct worker *w)
{
    for (size_t i = 0; i < w->judge->events.count; i++) {
        struct event e = ((struct event *)w->judge->events.data)[i];
        struct met met = {e, e.state, e.ordinal, i};
        if (e.ordinal < 0) { /* of a candidate */
            const struct candidate *c = candidate(w, (size_t)e.state);
            met.parent = c->parent;
            met.code = c->code;
            met.event.state = c->number;
        }
        *(struct met *)added(s->escape, &s->team->met, sizeof met) = met;
    }
}

static void note_all(struct search *s)
{
    struct vector *all = &s->team->met;
    all->count = 0;
    for (uint32_t i = 0; i < s->team->workers; i++)
        gather_events(s, s->team->worker + i);
    if (all->count)
        qsort(all->data, all->count, sizeof(struct met), compare_met);
    for (size_t i = 0; i < all->count; i++)
        note(s->judge, ((struct met *)all->data)[i].event);
}

static int64_t number_of_candidate(struct worker *w, int64_t i)
{
    return i < 0 ? -1 : (int64_t)candidate(w, (size_t)i)->number;
}

/* The extremes of a worker's states put together with those of others; states of earlier rounds have
 * lower numbers. */
static void join_measured(struct worker *w, struct measured *m, const struct measured *found)
{
    int64_t least = number_of_candidate(w, found->least_state);
    int64_t greatest = number_of_candidate(w, found->greatest_state);
    int64_t undefined = number_of_candidate(w, found->undefined);
    int less = m->least_state < 0 || found->least < m->least ||
               (found->least == m->least && least < m->least_state);
    int more = m->greatest_state < 0 || found->greatest > m->greatest ||
               (found->greatest == m->greatest && greatest < m->greatest_state);
    if (least >= 0 && less) {
        m->least = found->least;
        m->least_state = least;
    }
    if (greatest >= 0 && more) {
        m->greatest = found->greatest;
        m->greatest_state = greatest;
    }
    if (undefined >= 0 && (m->undefined < 0 || undefined < m->undefined))
        m->undefined = undefined;
}

#endif
