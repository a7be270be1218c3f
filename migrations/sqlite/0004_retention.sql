-- What retention goes by: what is over, by the time it ended, and whether a request is a stop of a tour.
CREATE INDEX requests_over ON requests (updated_us)
    WHERE state IN ('served', 'expired', 'withdrawn', 'superseded');
CREATE INDEX departures_over ON departures (updated_us)
    WHERE state IN ('completed', 'overdue', 'cancelled', 'missed');
CREATE INDEX stops_request ON stops (request_id);
CREATE INDEX calls_created ON calls (created_us);
