/* States that are reached: counted, looked up in batches, stored, judged. */
#ifndef REBSYNC_STORING_H
#define REBSYNC_STORING_H

#include "frontier.h"

/* --- what is wrong */

/* Whether an event is a violation. */
static int is_fault(const struct search *s, const struct event *found)
{
    if (found->kind == DEADLOCK)
        return s->deadlock_is_fault;
    if (found->kind != PREDICATE)
        return 1;
    for (uint32_t i = 0; i < s->fault_count; i++)
        if (s->faults[i] == found->pc)
            return 1;
    return 0;
}

/* Notes an event unless its cause is known. */
static void note(struct search *s, struct event found)
{
    const struct event *known = (struct event *)s->events.data;
    for (size_t i = 0; i < s->events.count; i++)
        if (known[i].kind == found.kind && known[i].pc == found.pc && known[i].rebec == found.rebec)
            return;
    *(struct event *)added(s->escape, &s->events, sizeof found) = found;
    s->violated |= s->first && is_fault(s, &found);
}

static struct valuation value_of(struct search *s, int32_t number)
{
    struct valuation found = kernel_evaluate(s->kernel, number);
    expect(s, found.answer);
    return found;
}

/* The extremes of a measure with the state observed last. */
static void measure(struct search *s, int32_t number, int64_t state)
{
    struct measured *m = s->measured + number;
    struct valuation found = value_of(s, s->model->predicates + number);
    if (!found.defined) {
        m->undefined = m->undefined < 0 ? state : m->undefined;
        return;
    }
    if (m->least_state < 0 || found.value < m->least) {
        m->least = found.value;
        m->least_state = state;
    }
    if (m->greatest_state < 0 || found.value > m->greatest) {
        m->greatest = found.value;
        m->greatest_state = state;
    }
}

/* A predicate that does not hold, or has no value, in the state observed last. */
static void judge_invariant(struct search *s, int32_t predicate, int64_t state)
{
    struct valuation found = value_of(s, predicate);
    if (!found.defined)
        note(s, (struct event){found.kind, found.pc, -1, state, -1});
    else if (!found.value)
        note(s, (struct event){PREDICATE, predicate, 0, state, -1});
}

/* What predicates and measures say of a state. */
static void judge_values(struct search *s, uint64_t state, const uint64_t *words)
{
    if (s->invariant_count || s->model->measures) {
        unpack(s, words, s->unpacked);
        kernel_observe(s->kernel, s->unpacked);
    }
    for (uint32_t i = 0; i < s->invariant_count; i++)
        judge_invariant(s, s->invariants[i], (int64_t)state);
    for (int32_t i = 0; i < s->model->measures; i++)
        measure(s, i, (int64_t)state);
}

static void judge(struct search *s, uint64_t state, const uint64_t *words, int deadlock)
{
    if (!s->judged_later)
        judge_values(s, state, words);
    if (deadlock)
        note(s, (struct event){DEADLOCK, 0, 0, (int64_t)state, -1});
}

/* --- batches */

/* Keeps a state, its step and its time. */
static void keep(struct search *s, const struct pending *p, const uint64_t *words, int64_t time)
{
    size_t size = s->words * sizeof *words;
    memcpy((char *)room_for(s->escape, &s->states, (s->count + 1) * size, 1) + s->count * size, words, size);
    *(uint32_t *)added(s->escape, &s->parents, sizeof(uint32_t)) = p->parent;
    if (s->until != NEVER)
        *(int64_t *)added(s->escape, &s->times, sizeof(int64_t)) = time;
}

/* The same with fingerprints: the state is kept as long as it waits. */
static void keep_waiting(struct search *s, const struct pending *p, const uint64_t *words, int64_t time)
{
    struct arrival arrival = {s->beginning ? 0 : p->parent, p->code};
    write_arrival(s->escape, &s->trail, arrival);
    push_state(s, words, time);
}

/* Puts a state into the set of those seen; 0 when it is there already. */
static int insert(struct search *s, const uint64_t *words, uint64_t hash)
{
    if (s->compact)
        return insert_print(s->escape, &s->prints, hash);
    uint64_t at = find(s, words, hash);
    if (s->table[at])
        return 0;
    s->table[at] = tag_of(s, hash) | (uint32_t)(s->count + 1);
    return 1;
}

/* The state whose step it is, not far before the one that is expanded. */
static uint64_t parent_of(const struct search *s, const struct pending *p)
{
    return s->expanded - (uint32_t)((uint32_t)s->expanded - p->parent);
}

static void settle(struct search *s, const struct pending *p, const uint64_t *words, struct sought at)
{
    if (p->kind && p->kind != DEADLOCK) {
        int64_t state = s->beginning ? -1 : (int64_t)parent_of(s, p);
        note(s, (struct event){p->kind, p->pc, p->rebec, state, p->code});
        return;
    }
    room_for_state(s);
    if (!insert(s, words, at.hash))
        return;
    if (s->compact)
        keep_waiting(s, p, words, at.time);
    else
        keep(s, p, words, at.time);
    judge(s, s->count++, words, p->kind == DEADLOCK);
}

/* Looks up and stores what has gathered, in its order. The first violation ends the search before the
 * state whose step it is: of later ones there are steps that are not counted. */
static void flush(struct search *s)
{
    struct batch *b = &s->batch;
    uint32_t count = b->count;
    b->count = 0;
    for (uint32_t i = 0; i < count; i++) {
        settle(s, b->steps + i, b->words + (size_t)i * s->words, s->sought[i]);
        if (!s->violated)
            continue;
        if (!s->beginning) {
            s->transitions -= count - i - 1;
            s->expanded = parent_of(s, b->steps + i);
        }
        longjmp(s->escape->to, VIOLATED);
    }
}

/* The next state to be expanded, packed; there is one. */
static const uint64_t *front(struct search *s)
{
    struct states *head = &s->frontier.head;
    if (!s->compact)
        return words_of(s, s->expanded);
    if (head->expanded == head->count) {
        flush(s);
        refill(s);
    }
    return packed_in(s, head, head->expanded);
}

/* Puts a step into a batch that has room for it; where its state is packed. */
static inline const uint64_t *gather(struct search *s, struct escape *out, struct batch *b, uint64_t parent,
                                     const struct transition *step)
{
    uint64_t *words = b->words + (size_t)b->count * s->words;
    int32_t kind = !step->state ? step->kind : step->deadlock ? DEADLOCK : 0;
    if (step->code > UINT32_MAX)
        give_up(out);
    b->steps[b->count++] = (struct pending){(uint32_t)parent, (uint32_t)step->code, step->pc, step->rebec, kind};
    if (step->state)
        pack(s, step->state, words);
    return words;
}

/* When the state that is expanded was reached. */
static int64_t time_before(struct search *s)
{
    const struct states *head = &s->frontier.head;
    if (s->beginning)
        return 0;
    return s->compact ? ((int64_t *)head->times.data)[head->expanded]
                      : ((int64_t *)s->times.data)[s->expanded];
}

/* Takes in a step that the kernel has made. */
static void store(void *search, const struct transition *step)
{
    struct search *s = search;
    struct sought at = {0, step->time};
    if (step->state && s->until != NEVER) {
        at.time += time_before(s);
        if (at.time > s->until) {
            s->dropped++;
            return;
        }
    }
    if (s->batch.count == BATCH || s->wide)
        flush(s);
    if (s->wide)
        repack(s);
    s->transitions += !s->beginning;
    const uint64_t *words = gather(s, s->escape, &s->batch, s->beginning ? step->code : s->expanded, step);
    if (step->state && s->compact) {
        at.hash = kernel_fingerprint(s->kernel, step->state);
        __builtin_prefetch(place_of_print(&s->prints, at.hash), 1);
    } else if (step->state) {
        at.hash = hash_ahead(s, words);
    }
    s->sought[s->batch.count - 1] = at;
}

#endif
